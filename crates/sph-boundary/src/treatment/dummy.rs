//! Walls of dummy particles after Adami, Hu & Adams (2012).

use sph_core::{SlipCondition, StepError, Vect, fields, plugin};
use sph_kernels::lanes::{Lane, dot};
use sph_neighbours::{LanePair, PairSum, Particles, WallSet, World, add_scaled, shepard, splat};

use crate::treatment::impact::LEAST_CLEARANCE;
use crate::treatment::near::NearLists;
use crate::treatment::outline::Outline;
use crate::treatment::shaped::shaped_by_outline;
use crate::treatment::shepard::EffectiveGravity;
use crate::{
    BoundaryError, PlanarWalls, Result, SpatialWalls, Wall, WallEntry, WallMesh, WallSetup,
    WallSpec, WallStates,
};

/// Layers of fixed particles behind the wall that take part in all sums like fluid particles.
///
/// p_w = Σ [p_f + ρ_f (g − a_w)·(r_w − r_f)] w / Σ w (their Eq. 27); no-slip by the velocity
/// 2 u_wall − Σ u_f w / Σ w in viscous sums (their Eq. 23). With a slip length λ and a particle at
/// the depth δ the mean velocity counts for u_wall by the share λ/(λ + δ). No renormalisation: the
/// layers fill the kernel. Walls thinner than two supports lack layers and push too little.
///
/// Source: Adami, Hu & Adams 2012, J. Comput. Phys. 231, 7057–7075.
///
/// ```toml
/// [walls.dummy-particles]
/// ```
#[plugin(WallEntry [2 => DummyParticles<2, PlanarWalls>, 3 => DummyParticles<3, SpatialWalls>], "dummy-particles",
    "layers of fixed particles behind the wall", source: "Adami, Hu & Adams 2012", cfg(not(test)))]
#[serde(bound = "")]
#[schemars(rename = "DummyParticles", bound = "")]
pub struct DummyParticles<const D: usize, M: WallMesh<D>> {
    #[serde(skip)]
    set_up: Option<SetUp<D, M>>,
}

#[derive(Debug)]
struct SetUp<const D: usize, M: WallMesh<D>> {
    outline: Outline<D, M>,
    /// Positions of the particles as drawn, with their wall.
    drawn: Vec<(usize, Vect<D>)>,
    /// λ/(λ + δ), empty unless a wall slips partly.
    slip: Vec<f64>,
    near: NearLists<D>,
    /// Pressures and velocities of the particles, kept for their memory.
    means: Vec<(f64, Vect<D>)>,
}

impl<const D: usize, M: WallMesh<D>> SetUp<D, M> {
    fn new(setup: &WallSetup<'_, D>) -> Result<Self> {
        let support = setup.kernel.support() * setup.smoothing_length;
        let rough = |w: &&WallSpec<D>| w.condition.slip == SlipCondition::Coulomb;
        if let Some(wall) = setup.walls.iter().find(rough) {
            let why = "has Coulomb's friction, which needs the wall elements of `walls.usaw`";
            return Err(BoundaryError::unfit(wall.drawing.name(), why));
        }
        let outline = Outline::<D, M>::new(setup, support, setup.spacing)?;
        // The mesh stands where it is at time 0; the layers move from there.
        let drawn = outline.mesh.layers(setup.spacing, support);
        let slip = |(wall, place): &(usize, Vect<D>)| {
            let slip = outline.specs[*wall].condition.slip_length();
            let depth = outline.mesh.nearest(place, support);
            slip / (slip + depth.map_or(support, |(d, _)| d))
        };
        let slip = match outline.slips() {
            true => drawn.iter().map(slip).collect(),
            false => Vec::new(),
        };
        Ok(SetUp {
            outline,
            drawn,
            slip,
            near: NearLists::default(),
            means: Vec::new(),
        })
    }

    fn place(&self, walls: &mut WallSet<D>) {
        self.outline.write(walls);
        let maps = self.outline.maps();
        for (v, (wall, drawn)) in self.drawn.iter().enumerate() {
            let place = maps[*wall]((*drawn).into()).into();
            self.outline.put_point(walls, v, *wall, place);
        }
    }
}

shaped_by_outline!(DummyParticles);

impl<const D: usize, M: WallMesh<D>> Wall<D> for DummyParticles<D, M> {
    fn lattice_offset(&self) -> f64 {
        0.5
    }

    fn build(&mut self, setup: &WallSetup<'_, D>) -> Result<WallSet<D>> {
        let set_up = SetUp::<D, M>::new(setup)?;
        let outline = &set_up.outline;
        let points = set_up.drawn.iter().map(|(wall, place)| {
            let velocity = outline.movement(*wall, place).velocity;
            (*wall, *place, 1.0, velocity)
        });
        let mut walls = WallSet {
            names: outline.mesh.names().to_vec(),
            points: outline.points_at(points),
            ..WallSet::default()
        };
        set_up.place(&mut walls);
        self.set_up = Some(set_up);
        Ok(walls)
    }

    fn geometry(&mut self, world: &mut World<D>) -> Result<(), StepError> {
        match &mut self.set_up {
            Some(set_up) => set_up.near.refresh(&mut set_up.outline, world),
            None => Ok(()),
        }
    }

    fn constrain(&mut self, world: &mut World<D>, dt: f64) -> Result<(), StepError> {
        if let Some(set_up) = &mut self.set_up {
            let (near, outline) = (&set_up.near, &set_up.outline);
            // No heights were measured here: all near particles are checked.
            set_up.outline.struck =
                near.constrain((outline, LEAST_CLEARANCE), (world, dt), |_| f64::NAN)?;
        }
        Ok(())
    }

    fn state(&mut self, world: &mut World<D>) -> Result<(), StepError> {
        let Some(set_up) = &mut self.set_up else {
            return Ok(());
        };
        let points = &world.walls.points;
        let mean = Means {
            velocity: world.free.get(fields::VELOCITY)?,
            pressure: world.free.get(fields::PRESSURE)?,
            density: world.free.get(fields::DENSITY)?,
            felt: EffectiveGravity {
                gravity: world.gravity,
                accelerations: &points.acceleration,
            },
        };
        let (walls, slip) = (&points.velocity, &set_up.slip);
        let image = |v: usize, (w, p, u): (f64, f64, [f64; D])| {
            let wall = walls[v];
            if w <= 0.0 {
                return (0.0, wall);
            }
            let mean = Vect::from(u) / w;
            let surface = match slip.get(v) {
                Some(share) => wall + (mean - wall) * *share,
                None => wall,
            };
            (p / w, surface * 2.0 - mean)
        };
        let list = (&world.lists.of_points, &world.lists.hidden.at_points);
        let means = &mut set_up.means;
        shepard(world, &points.position, list, &mean, means, image)?;
        let points = &mut world.walls.points;
        for (v, &(pressure, velocity)) in set_up.means.iter().enumerate() {
            points.pressure[v] = pressure;
            points.viscous_velocity[v] = velocity;
        }
        Ok(())
    }
}

/// Sums of w, p w and u w.
struct Means<'a, const D: usize> {
    velocity: &'a [Vect<D>],
    pressure: &'a [f64],
    density: &'a [f64],
    felt: EffectiveGravity<'a, D>,
}

impl<const D: usize> PairSum<D> for Means<'_, D> {
    const VALUES: bool = true;
    type Own<L: Lane> = [L; D];
    type Sum<L: Lane> = (L, L, [L; D]);

    #[inline(always)]
    fn own<L: Lane>(&self, targets: Particles) -> [L; D] {
        self.felt.own(targets)
    }

    #[inline(always)]
    fn pair<L: Lane>(
        &self,
        felt: &[L; D],
        j: usize,
        pair: &LanePair<D, L>,
        (weight, pressure, velocity): &mut Self::Sum<L>,
    ) {
        let w = pair.value;
        let hydrostatic = L::splat(self.density[j]) * dot(felt, &pair.separation);
        *weight += w;
        *pressure += w * (L::splat(self.pressure[j]) + hydrostatic);
        add_scaled(velocity, &splat(&self.velocity[j]), w);
    }
}
