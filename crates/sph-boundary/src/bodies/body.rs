//! The mover `rigid-body`.

use nalgebra::{Matrix3, Matrix6, Vector3};
use sph_core::{Vect, plugin};

use crate::bodies::dynamics::Dynamics;
use crate::bodies::freedom::{Freedom, Holds};
use crate::bodies::mooring::{Line, Mooring};
use crate::bodies::prescribed::{self, Prescribed};
use crate::bodies::shape::{Solid, layer, winding};
use crate::bodies::spatial_vector::padded;
use crate::geometry::vector::{bounds, widened};
use crate::{Drawing, Load, Mover, MoverEntry, MoverRefusal, MoverSetting, RigidState, Touch};

/// Least density of a body over that of the lightest fluid. Lighter ones are stable, but a blow of one particle of the
/// fluid throws them: it has several times their mass.
const LIGHTEST: f64 = 0.02;
/// Speed that a contact stops within half a spacing, over the largest speed of sound.
const FASTEST: f64 = 10.0;

/// A rigid body that floats, sinks and turns: Newton's and Euler's equations with the force of the fluid.
///
/// The force is the reaction to the force of the wall on the particles, so that momentum is conserved to rounding. Mass
/// and inertia follow from the shape where a `density` is given.
///
/// The pressure at a wall depends on its acceleration, and an acceleration that follows the force at once would make
/// light bodies swing from step to step. It is let follow: (M + A*) (ã' − ã) = M (a − ã), with a the acceleration of
/// the body, ã the one in the pressure, A* the inertia of a layer of fluid as thick as the smoothing length. The change
/// of ã per step is that of a body heavier by A*: no body is too light for it, and the body's own motion stays M a = F.
///
/// ```toml
/// [wall.float.mover.rigid-body]
/// density = 500
/// free = ["y", "rz"]
/// ```
#[plugin(MoverEntry [2, 3], "rigid-body", "a body that floats, sinks, turns and meets others",
    source: "Newton's second law, Euler's equations; Canelas et al. 2015")]
#[derive(Debug)]
pub struct RigidBody {
    /// Density of the body, kg/m³, beside fluid a fiftieth of its density or more; it or the `mass` has to be given.
    #[parameter(unit: "kg/m³", above: 0.0)]
    pub density: Option<f64>,
    /// Mass, kg (per metre of depth in two dimensions).
    #[parameter(unit: "kg", above: 0.0)]
    pub mass: Option<f64>,
    /// Centre of mass where the body is drawn, m; that of the shape if left out.
    #[parameter(unit: "m")]
    pub centre: Option<Vec<f64>>,
    /// Inertia about the centre of mass, kg m²: one number in two dimensions; in three the principal ones about x, y and z
    /// as the body is drawn, or xx, yy, zz, xy, yz, zx of the tensor. That of a uniform body of this mass if left out.
    #[parameter(unit: "kg m²", examples: [[1.0]])]
    pub inertia: Option<Vec<f64>>,
    /// Free degrees of freedom; all if left out. The others are locked.
    pub free: Option<Vec<Freedom>>,
    /// Velocity of the centre at the start, m/s.
    #[parameter(unit: "m/s")]
    pub velocity: Option<Vec<f64>>,
    /// Angular velocity at the start, rad/s: one number in two dimensions, three in three.
    #[parameter(unit: "rad/s", examples: [[1.0]])]
    pub angular_velocity: Option<Vec<f64>>,
    /// The time until which it goes on with the velocity that it has at the start, s: at rest if none is given.
    #[parameter(default, unit: "s", min: 0.0)]
    pub start: f64,
    /// Times in which it moves as given, under any load: one after the other, from `start` on.
    #[parameter(default)]
    pub prescribed: Vec<Prescribed>,
    /// Springs and dampers on its degrees of freedom.
    #[parameter(default)]
    pub hold: Holds,
    /// Lines to places that stay: elastic ones, and chains that hang.
    #[parameter(default)]
    pub line: Vec<Line>,
    /// Share of the normal velocity that is left after it meets a wall or a body.
    #[parameter(default, unit: "1", min: 0.0, max: 1.0)]
    pub restitution: f64,
    /// Coefficient of its friction on walls and bodies.
    #[parameter(default, unit: "1", min: 0.0)]
    pub friction: f64,
    #[serde(skip)]
    settled: Option<(Dynamics, Touch)>,
}

type Checked<T> = Result<T, MoverRefusal>;
type MassProperties = (f64, Vector3<f64>, Matrix3<f64>, bool);

fn vector<const D: usize>(key: &str, given: &Option<Vec<f64>>) -> Checked<Option<Vector3<f64>>> {
    match given {
        None => Ok(None),
        Some(given) if given.len() == D => Ok(Some(padded(given))),
        Some(given) => wrong_count(key, given.len(), &D.to_string()),
    }
}

fn refused<T>(key: &str, why: impl Into<String>) -> Checked<T> {
    Err(MoverRefusal::at_key(key, why))
}

fn wrong_count<T>(key: &str, found: usize, expected: &str) -> Checked<T> {
    refused(key, format!("{found} numbers, {expected} are expected"))
}

impl RigidBody {
    /// Mass, centre and inertia; true if the body is too light for any fluid.
    fn weighed<const D: usize>(&self, setting: &MoverSetting<'_, D>) -> Checked<MassProperties> {
        let solid = Solid::from_pieces(setting.pieces());
        let solid = solid.or_else(|e| refused("", e.to_string()))?;
        let mass = match (self.mass, self.density) {
            (Some(mass), None) => mass,
            (None, Some(density)) => density * solid.volume,
            (None, None) => return refused("", "a body needs a `density` or a `mass`"),
            (Some(_), Some(_)) => {
                return refused("mass", "a body has a `density` or a `mass`, not both");
            }
        };
        let density = mass / solid.volume;
        let [lightest, _] = setting.densities;
        let dry = density < LIGHTEST * lightest * (1.0 - 1e-9);
        if dry && beside_fluid(setting) {
            let key = self.mass.map_or("density", |_| "mass");
            let (volume, unit) = (solid.volume, ["m² per metre of depth", "m³"][D - 2]);
            let why = format!(
                "the body is too light: {density:.3} kg/m³ in a fluid of {lightest:.3} kg/m³, of which a fiftieth is the \
                 least; it has a volume of {volume:.3e} {unit}"
            );
            return refused(key, why);
        }
        let centre = vector::<D>("centre", &self.centre)?;
        let inertia = match (&self.inertia, centre) {
            (Some(given), _) => tensor::<D>(given)?,
            (None, Some(_)) => {
                let why = "a body with a `centre` of its own needs its `inertia` about it";
                return refused("centre", why);
            }
            (None, None) => solid.inertia * density,
        };
        Ok((mass, centre.unwrap_or(solid.centre), inertia, dry))
    }

    fn freedoms<const D: usize>(&self) -> Checked<[bool; 6]> {
        let there = Freedom::in_dimension(D);
        let names: Vec<&str> = there.iter().map(|f| f.name()).collect();
        let names = names.join(", ");
        let mut free = [false; 6];
        for (k, freedom) in self.free.as_deref().unwrap_or(there).iter().enumerate() {
            if !there.contains(freedom) {
                let why = format!("there is no `{}` in {D}D: {names}", freedom.name());
                return refused(&format!("free[{k}]"), why);
            }
            free[freedom.index()] = true;
        }
        if free == [false; 6] {
            let why = format!("nothing is free: leave the mover out, or free some of {names}");
            return refused("free", why);
        }
        for (freedom, ..) in self.hold.all() {
            if !free[freedom.index()] {
                let name = freedom.name();
                let why = format!("`{name}` is not free, so that nothing has to hold it");
                return refused(&format!("hold.{name}"), why);
            }
        }
        Ok(free)
    }

    /// Penalty of contact: a face of the body stops ten times the speed of sound within half a spacing.
    fn touch_of<const D: usize>(
        &self,
        setting: &MoverSetting<'_, D>,
        dynamics: &Dynamics,
        (surface, dry): (f64, bool),
    ) -> Touch {
        let (mass, face) = (dynamics.mass, surface / (2.0 * D as f64));
        let fastest = FASTEST * setting.sound_speed / (0.5 * setting.spacing);
        Touch {
            mass,
            inertia: match dynamics.free[3..] {
                [false, false, false] => f64::INFINITY,
                _ if D == 2 => dynamics.inertia[(2, 2)],
                _ => dynamics.inertia.symmetric_eigenvalues().min(),
            },
            face,
            stiffness: mass * fastest.powi(2) / face,
            restitution: self.restitution,
            friction: self.friction,
            dry,
        }
    }
}

/// True if fluid is drawn within a support of the wall: two boxes around both meet.
fn beside_fluid<const D: usize>(setting: &MoverSetting<'_, D>) -> bool {
    let places = setting.pieces().flat_map(Drawing::points::<D>);
    let [least, most] = widened(bounds(places), 3.0 * setting.smoothing_length);
    let meets = |(low, high): &([f64; D], [f64; D])| {
        (0..D).all(|k| low[k] <= most[k] && high[k] >= least[k])
    };
    setting.fluid.iter().any(meets)
}

fn corners(drawing: &Drawing) -> Vec<Vector3<f64>> {
    drawing.points().into_iter().map(Vector3::from).collect()
}

/// Refuses a body that holds a corner of another wall, or has one in it.
fn check_separate<const D: usize>(setting: &MoverSetting<'_, D>) -> Checked<()> {
    let own = || setting.pieces();
    for other in setting.others() {
        let holds = corners(other).into_iter().any(|x| winding(own(), x) > 0.75);
        let mut within = own().flat_map(corners);
        if holds || within.any(|x| winding([other], x) > 0.75) {
            let (wall, name) = (setting.wall, other.name());
            let why = format!("the body `{wall}` overlaps the wall `{name}` at the start");
            return refused("", why);
        }
    }
    Ok(())
}

fn tensor<const D: usize>(given: &[f64]) -> Checked<Matrix3<f64>> {
    let tensor = match (D, given) {
        (2, [about]) => Matrix3::from_diagonal(&Vector3::new(0.0, 0.0, *about)),
        (3, [x, y, z]) => Matrix3::from_diagonal(&Vector3::new(*x, *y, *z)),
        (3, [xx, yy, zz, xy, yz, zx]) => Matrix3::new(*xx, *xy, *zx, *xy, *yy, *yz, *zx, *yz, *zz),
        _ => return wrong_count("inertia", given.len(), ["1", "3 or 6"][D - 2]),
    };
    let sound = match D {
        2 => tensor[(2, 2)] > 0.0,
        // No moment is more than the sum of the other two.
        _ => {
            let moments = tensor.symmetric_eigenvalues();
            moments.min() > 0.0 && 2.0 * moments.max() <= moments.sum() * (1.0 + 1e-12)
        }
    };
    match sound {
        true => Ok(tensor),
        false => refused(
            "inertia",
            "no body has it: principal moments are positive, and none is more than the sum of the others",
        ),
    }
}

impl<const D: usize> Mover<D> for RigidBody {
    fn prepare(&mut self, setting: &MoverSetting<'_, D>) -> Checked<()> {
        if !setting.flush {
            let why = "half a row of fluid clings to these walls and would be carried along: give `[walls.usaw]` the key \
                       `vertices = false`";
            return refused("", why);
        }
        let (mass, centre, inertia, dry) = self.weighed(setting)?;
        check_separate(setting)?;
        let free = self.freedoms::<D>()?;
        let lines = self.line.iter().enumerate();
        let lines = lines.map(|(k, line)| Mooring::new(line, k, setting));
        let lines: Vec<_> = lines.collect::<Result<_, _>>()?;
        let corners = setting.pieces().flat_map(corners);
        let far = corners.map(|x| (x - centre).norm());
        let bounds = [far.fold(0.0, f64::max), setting.sound_speed];
        prescribed::check::<D>(&self.prescribed, self.start, bounds)?;
        vector::<D>("velocity", &self.velocity)?;
        let turns = if D == 2 { 1 } else { 3 };
        if let Some(given) = self.angular_velocity.as_ref().filter(|g| g.len() != turns) {
            return wrong_count("angular_velocity", given.len(), &turns.to_string());
        }
        let [_, heaviest] = setting.densities;
        let pieces = || setting.pieces();
        let layer = layer(pieces(), centre, heaviest, setting.smoothing_length);
        // The trace of Σ S n nᵀ is the surface.
        let surface =
            (layer[(0, 0)] + layer[(1, 1)] + layer[(2, 2)]) / (heaviest * setting.smoothing_length);
        let dynamics = Dynamics {
            mass,
            centre,
            inertia,
            layer,
            free,
            holds: self.hold.all().collect(),
            lines,
            start: self.start,
            prescribed: self.prescribed.clone(),
        };
        let touch = self.touch_of(setting, &dynamics, (surface, dry));
        self.settled = Some((dynamics, touch));
        Ok(())
    }

    fn touch(&self) -> Option<Touch> {
        self.settled.as_ref().map(|(_, touch)| *touch)
    }

    fn pulls(&self, now: &RigidState<D>) -> Vec<(Vect<D>, f64)> {
        let settled = self.settled.as_ref();
        settled.map_or(Vec::new(), |(dynamics, _)| dynamics.pulls(now))
    }

    fn start(&self) -> RigidState<D> {
        let mut state = RigidState::default();
        let Some((dynamics, _)) = &self.settled else {
            return state;
        };
        state.centre = std::array::from_fn(|k| dynamics.centre[k]);
        if let Some(velocity) = &self.velocity {
            state.velocity = Vect::from_fn(|k, _| velocity[k]);
        }
        match self.angular_velocity.as_deref() {
            Some([about]) => state.angular_velocity[2] = *about,
            Some(about) => state.angular_velocity = padded(about).into(),
            None => {}
        }
        state
    }

    fn mobility(&self, now: &RigidState<D>, time: f64) -> Option<Matrix6<f64>> {
        let (dynamics, _) = self.settled.as_ref()?;
        Some(dynamics.mobility(now, time))
    }

    fn next(&self, now: &RigidState<D>, load: &Load<D>, time: f64, dt: f64) -> RigidState<D> {
        match &self.settled {
            Some((dynamics, _)) => dynamics.next(now, load, time, dt),
            None => *now,
        }
    }
}
