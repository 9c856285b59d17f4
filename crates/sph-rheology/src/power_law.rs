//! The power-law fluid.

use crate::{Inputs, Needs, Rheology, plugin};

/// η = K γ̇^(n−1), held between a smallest and a largest viscosity.
///
/// n < 1 thins with shear and has no largest viscosity of its own, n > 1 thickens and has none
/// either: the bound is part of the law.
///
/// Source: Ostwald 1925, de Waele 1923.
///
/// ```toml
/// [phase.paint.rheology.power-law]
/// consistency = 2.0
/// exponent = 0.6
/// largest_viscosity = "50 Pa s"
/// ```
#[plugin(crate::RheologyEntry, "power-law", "viscosity as a power of the strain rate, bounded", source: "Ostwald 1925")]
pub struct PowerLaw {
    /// Consistency K.
    #[parameter(unit: "Pa s^n", min: 0.0, source: "Ostwald 1925")]
    pub consistency: f64,
    /// Exponent n; 1 is a Newtonian fluid.
    #[parameter(unit: "1", above: 0.0, source: "Ostwald 1925")]
    pub exponent: f64,
    /// Bound of the viscosity from below.
    #[parameter(default, unit: "Pa s", min: 0.0, source: "ours")]
    pub smallest_viscosity: f64,
    /// Bound of the viscosity from above.
    #[parameter(unit: "Pa s", above: 0.0, source: "ours")]
    pub largest_viscosity: f64,
}

impl PowerLaw {
    /// η at a strain rate, Pa s.
    pub fn at(&self, strain_rate: f64) -> f64 {
        let power = match self.exponent {
            1.0 => 1.0,
            n => strain_rate.powf(n - 1.0),
        };
        // 0 · ∞ is no number: a fluid without consistency has no viscosity at rest either.
        let eta = match self.consistency {
            0.0 => 0.0,
            k => k * power,
        };
        eta.max(self.smallest_viscosity).min(self.largest_viscosity)
    }
}

impl Rheology for PowerLaw {
    fn needs(&self) -> Needs {
        Needs {
            strain_rate: self.uniform_viscosity().is_none(),
            pressure: false,
        }
    }
    fn uniform_viscosity(&self) -> Option<f64> {
        let newtonian = self.exponent == 1.0 || self.consistency == 0.0;
        newtonian.then(|| self.at(1.0))
    }
    fn viscosity(&self, inputs: &Inputs<'_>, viscosity: &mut [f64]) {
        for (k, eta) in viscosity.iter_mut().enumerate() {
            *eta = self.at(inputs.at(k).0);
        }
    }
    fn largest_viscosity(&self) -> f64 {
        self.uniform_viscosity().unwrap_or(self.largest_viscosity)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn stress_is_a_power_between_the_bounds() {
        for n in [0.3, 0.6, 1.0, 1.7] {
            let law = PowerLaw {
                consistency: 2.0,
                exponent: n,
                smallest_viscosity: 1e-3,
                largest_viscosity: 50.0,
            };
            let stress = |rate: f64| law.at(rate) * rate;
            let slope = (stress(2.0) / stress(1.0)).log2();
            assert!((slope - n).abs() < 1e-14, "{n}: {slope}");
            let ends = [law.at(0.0), law.at(1e12)];
            assert!(ends.iter().all(|e| (1e-3..=50.0).contains(e)), "{ends:?}");
        }
    }
}
