//! The Taylor–Green vortex.

use std::f64::consts::TAU;

use sph_core::{Vect, plugin};

use crate::{Solution, SolutionEntry};

/// u = −U cos(kx) sin(ky) e^(bt), v = U sin(kx) cos(ky) e^(bt),
/// p = −ρU²/4 (cos 2kx + cos 2ky) e^(2bt) with k = 2π/L, b = −2νk².
///
/// Source: Taylor & Green 1937; the kinetic energy decays with 2b.
#[plugin(SolutionEntry [2], "taylor-green", "decaying periodic vortices", source: "Taylor & Green 1937")]
pub struct TaylorGreen {
    /// Largest velocity U at the start.
    #[parameter(unit: "m/s")]
    pub speed: f64,
    /// Period L of the vortices.
    #[parameter(unit: "m", above: 0.0)]
    pub length: f64,
    /// Kinematic viscosity ν.
    #[parameter(unit: "m²/s", min: 0.0)]
    pub kinematic_viscosity: f64,
    /// Density ρ.
    #[parameter(unit: "kg/m³", above: 0.0)]
    pub density: f64,
}

impl TaylorGreen {
    fn rate(&self) -> f64 {
        -2.0 * self.kinematic_viscosity * (TAU / self.length).powi(2)
    }
}

impl Solution<2> for TaylorGreen {
    fn velocity(&self, x: &Vect<2>, time: f64) -> Option<Vect<2>> {
        let k = TAU / self.length;
        let u = self.speed * (self.rate() * time).exp();
        Some(Vect::from([
            -u * (k * x[0]).cos() * (k * x[1]).sin(),
            u * (k * x[0]).sin() * (k * x[1]).cos(),
        ]))
    }

    fn pressure(&self, x: &Vect<2>, time: f64) -> Option<f64> {
        let k = TAU / self.length;
        let decay = (2.0 * self.rate() * time).exp();
        let scale = -0.25 * self.density * self.speed * self.speed * decay;
        Some(scale * ((2.0 * k * x[0]).cos() + (2.0 * k * x[1]).cos()))
    }

    fn energy_rate(&self) -> Option<f64> {
        Some(2.0 * self.rate())
    }
}
