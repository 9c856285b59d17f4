//! A wall on a spring and a damper.

use serde::{Deserialize, Deserializer, de::Error};
use sph_core::{Vect, plugin};

use crate::{Load, Mover, MoverEntry, RigidState};

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
