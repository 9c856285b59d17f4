//! A standing shear wave in an elastic material.

use std::f64::consts::TAU;

use sph_core::{Vect, plugin};

use crate::{Solution, SolutionEntry, solutions::along};

/// u = U cos(ωt) sin(ky) along x with k = 2π/λ and ω = k√(𝒢/ρ).
///
/// Symbols: U largest velocity (m/s); λ wavelength (m); 𝒢 shear modulus (Pa); ρ density (kg/m³); y
/// the last coordinate. The displacement is U/ω sin(ωt) sin(ky); it must stay far below 1/k.
///
/// Source: Achenbach 1973, §1.5.
#[plugin(SolutionEntry [2, 3], "elastic-shear-wave", "standing shear wave in an elastic material",
    source: "Achenbach 1973, §1.5")]
pub struct ElasticShearWave {
    /// Largest velocity U.
    #[parameter(unit: "m/s")]
    pub speed: f64,
    /// Wavelength λ.
    #[parameter(unit: "m", above: 0.0)]
    pub wavelength: f64,
    /// Shear modulus 𝒢.
    #[parameter(unit: "Pa", above: 0.0, quantity: "modulus")]
    pub shear_modulus: f64,
    /// Density ρ.
    #[parameter(unit: "kg/m³", above: 0.0)]
    pub density: f64,
}

impl<const D: usize> Solution<D> for ElasticShearWave {
    fn velocity(&self, position: &Vect<D>, time: f64) -> Option<Vect<D>> {
        let k = TAU / self.wavelength;
        let frequency = k * (self.shear_modulus / self.density).sqrt();
        let shape = (k * position[D - 1]).sin();
        along(0, self.speed * (frequency * time).cos() * shape)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn acceleration_is_that_of_the_stress() {
        let wave = ElasticShearWave {
            speed: 0.3,
            wavelength: 2.0,
            shear_modulus: 5.0,
            density: 1.25,
        };
        let u = |t| Solution::<2>::velocity(&wave, &[0.1, 0.3].into(), t);
        let at = |t| u(t).unwrap().x;
        // ρ d²u/dt² = 𝒢 d²u/dy² = −𝒢k²u.
        let (t, dt) = (0.37, 1e-4);
        let second = (at(t + dt) - 2.0 * at(t) + at(t - dt)) / (dt * dt);
        let k = TAU / 2.0;
        assert!((1.25 * second + 5.0 * k * k * at(t)).abs() < 1e-5);
    }
}
