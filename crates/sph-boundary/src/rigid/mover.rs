//! Movers of walls: the trait, the loads on a wall, the scene as its mover gets it, and a spring.

use nalgebra::Matrix6;
use serde::{Deserialize, Deserializer, de::Error};
use sph_core::{Vect, contract, plugin};
use sph_neighbours::DepthGauge;

use crate::{Drawing, RigidMotion, RigidState};

/// Moves one wall. The wall's state is its whole memory: it is rolled back with the particles, and in checkpoints.
pub trait Mover<const D: usize>: Send + Sync + std::fmt::Debug {
    /// Takes the geometry of its wall and of its surroundings; called once, first of all.
    ///
    /// # Errors
    /// The key of its table that does not fit the scene.
    fn prepare(&mut self, _setting: &MoverSetting<'_, D>) -> Result<(), MoverRefusal> {
        Ok(())
    }
    /// Contact law of the wall; none if nothing stops it. Its place among walls that touch is then in [`Load`].
    fn touch(&self) -> Option<Touch> {
        None
    }
    /// The state at time 0.
    fn start(&self) -> RigidState<D>;
    /// True if it needs the force of the fluid on the wall; the force is then measured before every kick.
    fn needs_forces(&self) -> bool {
        true
    }
    /// The gauge of the depth before its wall, in a state; the depth there is then in [`Load`].
    fn looks(&self, _now: &RigidState<D>) -> Option<DepthGauge<D>> {
        None
    }
    /// Forces of the lines on the wall in a state: the force of each on it, N, and its tension at the other end, N;
    /// none if it hangs on nothing.
    fn pulls(&self, _now: &RigidState<D>) -> Vec<(Vect<D>, f64)> {
        Vec::new()
    }
    /// Inverse of mass and inertia in a state at a time, s: the change of both velocities over an impulse and its moment
    /// about the centre, with zeros for locked freedoms; none for a wall without mass.
    fn mobility(&self, _now: &RigidState<D>, _time: f64) -> Option<Matrix6<f64>> {
        None
    }
    /// The state at `time + dt` from that at `time`, s, with the load of the last evaluation.
    fn next(&self, now: &RigidState<D>, load: &Load<D>, time: f64, dt: f64) -> RigidState<D>;
}

contract!(
    /// A mover that a wall may name.
    pub MoverEntry, "mover", InWall, "the motion of a wall by the force of the fluid on it", Mover<D>
);

/// Prescribed courses ignore forces.
impl<const D: usize> Mover<D> for RigidMotion<D> {
    fn start(&self) -> RigidState<D> {
        self.state(0.0)
    }
    fn needs_forces(&self) -> bool {
        false
    }
    fn next(&self, _: &RigidState<D>, _: &Load<D>, time: f64, dt: f64) -> RigidState<D> {
        self.state(time + dt)
    }
}

/// Forces and moments that act on a wall.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Load<const D: usize> {
    /// Force of the fluid, N (N/m in two dimensions): the reaction to the force of the wall on the particles.
    pub force: Vect<D>,
    /// Its moment about the origin, N m; only the last component in two dimensions.
    pub moment: [f64; 3],
    /// Force of walls that it touches, N; zero unless its mover gives a [`Touch`].
    pub contact_force: Vect<D>,
    /// Its moment about the origin, N m.
    pub contact_moment: [f64; 3],
    /// Depth of the fluid before the wall, m, for a mover that [looks](crate::Mover::looks); none if there is no fluid.
    pub depth: Option<f64>,
    /// Gravity, m/s²; the mover applies it to the wall.
    pub gravity: Vect<D>,
}

impl<const D: usize> Load<D> {
    /// Gravity alone.
    pub fn of_gravity(gravity: Vect<D>) -> Self {
        Load {
            force: Vect::zeros(),
            moment: [0.0; 3],
            contact_force: Vect::zeros(),
            contact_moment: [0.0; 3],
            depth: None,
            gravity,
        }
    }
}

/// Contact law of a wall that its mover moves freely.
///
/// Where two surfaces are nearer than a spacing, or than they were drawn, each area S of one pushes the other with
/// N = S k δ, δ the missing distance, with e² of that while they part (Walton & Braun 1986), and rubs with
/// min(μ N, 2 S √(k m / ΣS) u_t). A step is taken in parts that resolve the fastest swing of a body on its
/// contacts.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Touch {
    /// Mass m, kg (per metre of depth in two dimensions); of two bodies m₁m₂/(m₁ + m₂) counts.
    pub mass: f64,
    /// Least inertia about its centre, kg m²; infinite if it does not turn.
    pub inertia: f64,
    /// Area of a face, m^(D−1): that of a box in the mean.
    pub face: f64,
    /// Stiffness k, Pa/m; of two bodies the smaller one counts, but on the smaller face never less than holds the weight
    /// of all bodies within a fortieth of the spacing.
    pub stiffness: f64,
    /// Share e of the velocity that is left after an impact. Of two bodies the smaller one counts.
    pub restitution: f64,
    /// Coefficient of friction μ; of two bodies √(μ₁μ₂) counts.
    pub friction: f64,
    /// True if the wall is too light for any fluid, so that a step in which fluid acts on it fails.
    pub dry: bool,
}

/// The scene as a mover gets it before the start.
#[derive(Clone, Copy, Debug)]
pub struct MoverSetting<'a, const D: usize> {
    /// Name of its wall.
    pub wall: &'a str,
    /// All walls as they are drawn; several pieces of a wall have one name.
    pub walls: &'a [&'a Drawing],
    /// Particle spacing δr, m.
    pub spacing: f64,
    /// Smoothing length h, m.
    pub smoothing_length: f64,
    /// Boxes around the regions that are filled with fluid, m.
    pub fluid: &'a [([f64; D], [f64; D])],
    /// Densities of the lightest and the heaviest phase, kg/m³.
    pub densities: [f64; 2],
    /// The largest speed of sound c, m/s.
    pub sound_speed: f64,
    /// Gravity, m/s².
    pub gravity: Vect<D>,
    /// True if the particles begin at the wall, so that the reaction to the particles is the force on the wall; without
    /// it half a row of fluid clings to the wall.
    pub flush: bool,
}

impl<'a, const D: usize> MoverSetting<'a, D> {
    /// The pieces of its wall.
    pub fn pieces(&self) -> impl Iterator<Item = &'a Drawing> {
        let (walls, wall) = (self.walls, self.wall);
        walls.iter().copied().filter(move |w| w.name() == wall)
    }

    /// The pieces of all other walls.
    pub fn others(&self) -> impl Iterator<Item = &'a Drawing> {
        let (walls, wall) = (self.walls, self.wall);
        walls.iter().copied().filter(move |w| w.name() != wall)
    }
}

/// Refusal of a mover to move its wall: a key of its table, and the fault there.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct MoverRefusal {
    /// The key in its table; the table itself, if empty.
    pub key: String,
    /// The defect and its remedy.
    pub why: String,
}

impl MoverRefusal {
    /// Of a key.
    pub fn at_key(key: impl Into<String>, why: impl Into<String>) -> Self {
        MoverRefusal {
            key: key.into(),
            why: why.into(),
        }
    }
}

/// A wall that slides along a line, pushed by the fluid and held by a spring and a damper:
/// m s̈ = (F + m g)·e − k s − c ṡ, from rest where it is drawn.
///
/// Spring and damper are taken at the end of the step, (m + Δt c + Δt² k) ṡ' = m ṡ + Δt ((F + m g)·e − k s), so that
/// they never bound it; s' = s + Δt ṡ'. The force of the fluid is that of the last evaluation: a wall much lighter than
/// the fluid that it has to move along swings, and the more the longer the step.
///
/// ```toml
/// [wall.piston.mover.spring]
/// along = [1, 0]
/// mass = 20
/// stiffness = "4 kN/m"
/// damping = 600
/// ```
#[plugin(MoverEntry [2 => Spring<2>, 3 => Spring<3>], "spring",
    "a wall that slides along a line on a spring and a damper",
    source: "Newton's second law, spring and damper at the end of the step")]
#[serde(bound = "")]
#[schemars(rename = "Spring", bound = "")]
pub struct Spring<const D: usize> {
    /// Direction e; its length does not matter.
    #[serde(deserialize_with = "direction")]
    #[schemars(with = "Vec<f64>")]
    #[parameter(unit: "1")]
    along: [f64; D],
    /// Mass m of the wall, kg (per metre of depth in two dimensions).
    #[parameter(unit: "kg", above: 0.0)]
    mass: f64,
    /// Stiffness k of the spring, N/m (per metre of depth in two dimensions).
    #[parameter(default, unit: "N/m", min: 0.0)]
    stiffness: f64,
    /// Damping c, N s/m (per metre of depth in two dimensions).
    #[parameter(default, unit: "N s/m", min: 0.0)]
    damping: f64,
}

/// A unit vector of D numbers.
fn direction<'de, const D: usize, De: Deserializer<'de>>(from: De) -> Result<[f64; D], De::Error> {
    let given = Vec::<f64>::deserialize(from)?;
    let vector: [f64; D] = given.try_into().map_err(|given: Vec<f64>| {
        De::Error::custom(format!(
            "`along` has {} numbers, {D} are expected",
            given.len()
        ))
    })?;
    let unit = Vect::from(vector).try_normalize(0.0);
    unit.map(Into::into)
        .ok_or_else(|| De::Error::custom("`along` has no length"))
}

impl<const D: usize> Mover<D> for Spring<D> {
    fn start(&self) -> RigidState<D> {
        RigidState::default()
    }
    fn next(&self, now: &RigidState<D>, load: &Load<D>, _: f64, dt: f64) -> RigidState<D> {
        let along = Vect::from(self.along);
        let way = along.dot(&Vect::from(now.pose.translation));
        let speed = along.dot(&now.velocity);
        let push = along.dot(&(load.force + load.gravity * self.mass));
        let inertia = self.mass + dt * self.damping + dt * dt * self.stiffness;
        let change = dt * (push - self.stiffness * way - self.damping * speed)
            - dt * dt * self.stiffness * speed;
        let next = speed + change / inertia;
        let mut state = *now;
        state.velocity = along * next;
        state.acceleration = along * ((next - speed) / dt);
        state.pose.translation = (along * (way + dt * next)).into();
        state
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Without a fluid: the period of a free swing, and its energy, at a fortieth of the period.
    #[test]
    fn a_free_swing_has_its_period_to_a_per_cent() {
        let spring = Spring::<2> {
            along: [0.6, 0.8],
            mass: 2.0,
            stiffness: 8.0,
            damping: 0.0,
        };
        let none = Load::of_gravity(Vect::zeros());
        let period = std::f64::consts::TAU * (2.0_f64 / 8.0).sqrt();
        let dt = period / 400.0;
        let mut state = Mover::<2>::start(&spring);
        state.pose.translation = [0.06, 0.08];
        let (mut crossings, mut before) = (Vec::new(), 0.1);
        for n in 0..1200 {
            state = spring.next(&state, &none, 0.0, dt);
            let [x, y] = state.pose.translation;
            let way = 0.6 * x + 0.8 * y;
            if way < 0.0 && before >= 0.0 {
                crossings.push((f64::from(n) + before / (before - way)) * dt);
            }
            before = way;
        }
        let off = (crossings[1] - crossings[0]) / period - 1.0;
        assert!(off.abs() < 0.01, "{off}");
    }
}
