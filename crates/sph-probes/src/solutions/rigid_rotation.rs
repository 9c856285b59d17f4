//! Rigid rotation of a fluid.

use sph_core::{Vect, plugin};

use crate::flow::point::point;
use crate::{Solution, SolutionEntry};

/// u = ω × (r − c), p = p_c + ½ ρ ω² s² with s the distance from the axis; without gravity.
///
/// The axis is the normal of the plane in two dimensions and z in three.
///
/// Source: Batchelor 1967, §4.1.
///
/// ```toml
/// [body.water.initial.rigid-rotation]
/// angular_velocity = 6.2832
/// centre = [0.5, 0.5]
/// ```
#[plugin(SolutionEntry [2, 3], "rigid-rotation", "a fluid that turns like a solid", source: "Batchelor 1967, §4.1")]
pub struct RigidRotation {
    /// Angular velocity ω, counter-clockwise.
    #[parameter(unit: "rad/s")]
    pub angular_velocity: f64,
    /// A point c on the axis; the origin if left out.
    #[parameter(default, unit: "m")]
    pub centre: Vec<f64>,
    /// Density ρ, for the pressure.
    #[parameter(default, unit: "kg/m³")]
    pub density: f64,
    /// Pressure p_c on the axis.
    #[parameter(default, unit: "Pa")]
    pub central_pressure: f64,
}

impl<const D: usize> Solution<D> for RigidRotation {
    fn velocity(&self, position: &Vect<D>, _time: f64) -> Option<Vect<D>> {
        let arm = position - point::<D>(&self.centre);
        let mut velocity = Vect::zeros();
        velocity[0] = -self.angular_velocity * arm[1];
        velocity[1] = self.angular_velocity * arm[0];
        Some(velocity)
    }

    fn pressure(&self, position: &Vect<D>, _time: f64) -> Option<f64> {
        let arm = position - point::<D>(&self.centre);
        let speed2 = self.angular_velocity.powi(2) * (arm[0] * arm[0] + arm[1] * arm[1]);
        Some(self.central_pressure + 0.5 * self.density * speed2)
    }

    fn energy_rate(&self) -> Option<f64> {
        Some(0.0)
    }
}
