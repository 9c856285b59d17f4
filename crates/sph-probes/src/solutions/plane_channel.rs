//! Channel flows between planes that start from rest: plane Couette and plane Poiseuille flow.

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

/// u = a/(2ν) η(H−η) − Σ_n 4aH²/(νπ³(2n+1)³) sin(πη(2n+1)/H) exp(−(2n+1)²π²νt/H²), with η the
/// distance from the lower wall.
///
/// Source: Morris et al. 1997, Eq. 21.
#[plugin(SolutionEntry [2, 3], "poiseuille", "plane channel flow driven by a body force, started from rest",
    source: "Morris et al. 1997, Eq. 21")]
pub struct Poiseuille {
    /// Driving acceleration a along x.
    #[parameter(unit: "m/s²")]
    pub acceleration: f64,
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

impl<const D: usize> Solution<D> for Poiseuille {
    fn velocity(&self, position: &Vect<D>, time: f64) -> Option<Vect<D>> {
        let (a, nu, height) = (self.acceleration, self.kinematic_viscosity, self.height);
        let eta = position[D - 1] - self.bottom;
        let mut u = 0.5 * a / nu * eta * (height - eta);
        for n in 0..200 {
            let k = f64::from(2 * n + 1);
            let decay = (-k * k * PI * PI * nu * time / (height * height)).exp();
            if decay < 1e-18 {
                break;
            }
            let amplitude = 4.0 * a * height * height / (nu * PI.powi(3) * k.powi(3));
            u -= amplitude * (PI * eta * k / height).sin() * decay;
        }
        along(0, u)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_starts_at_rest_and_becomes_a_parabola() {
        let flow = Poiseuille {
            acceleration: 0.8,
            kinematic_viscosity: 0.1,
            height: 1.0,
            bottom: 0.0,
        };
        let u = |y: f64, t| Solution::<2>::velocity(&flow, &[0.0, y].into(), t);
        let at = |y, t| u(y, t).unwrap().x;
        assert!(at(0.3, 0.0).abs() < 1e-6, "u(t=0) = {:e}", at(0.3, 0.0));
        assert!((at(0.5, 1e3) - 1.0).abs() < 1e-14);
        assert!(at(0.0, 1.0).abs() < 1e-14 && at(1.0, 1.0).abs() < 1e-12);
    }
}
