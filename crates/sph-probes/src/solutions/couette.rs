//! Plane Couette flow.

use std::f64::consts::PI;

use sph_core::{Vect, plugin};

use crate::{Solution, SolutionEntry, solutions::along};

/// u = U η/H + Σ_n 2U/(nπ) (−1)ⁿ sin(nπη/H) exp(−n²π²νt/H²): the upper wall starts at t = 0.
///
/// Source: Morris et al. 1997, Eq. 20.
#[plugin(SolutionEntry [2, 3], "couette", "channel flow dragged by its upper wall, started from rest",
    source: "Morris et al. 1997, Eq. 20")]
pub struct Couette {
    /// Velocity U of the upper wall along x.
    #[parameter(unit: "m/s")]
    pub wall_velocity: f64,
    /// Kinematic viscosity ν.
    #[parameter(unit: "m²/s", above: 0.0)]
    pub kinematic_viscosity: f64,
    /// Height H of the channel.
    #[parameter(unit: "m", above: 0.0)]
    pub height: f64,
    /// Ordinate of the lower wall.
    #[parameter(default, unit: "m")]
    pub bottom: f64,
}

impl<const D: usize> Solution<D> for Couette {
    fn velocity(&self, position: &Vect<D>, time: f64) -> Option<Vect<D>> {
        let eta = (position[D - 1] - self.bottom) / self.height;
        let rate = PI * PI * self.kinematic_viscosity * time / (self.height * self.height);
        let mut u = self.wall_velocity * eta;
        for n in 1..400 {
            let k = f64::from(n);
            let decay = (-k * k * rate).exp();
            if decay < 1e-18 {
                break;
            }
            let sign = if n % 2 == 0 { 1.0 } else { -1.0 };
            u += 2.0 * self.wall_velocity / (k * PI) * sign * (k * PI * eta).sin() * decay;
        }
        along(0, u)
    }
}
