//! The Cross fluid.

use crate::{Inputs, Needs, Rheology, plugin};

/// η = η_∞ + (η_0 − η_∞)/(1 + (λγ̇)^m), between η_0 at rest and η_∞ at high strain rates.
///
/// Source: Cross 1965.
///
/// ```toml
/// [phase.polymer.rheology.cross]
/// rest_viscosity = "10 Pa s"
/// infinite_viscosity = "0.1 Pa s"
/// relaxation_time = "2 s"
/// exponent = 0.8
/// ```
#[plugin(crate::RheologyEntry, "cross", "from one viscosity at rest to another at high strain rates",
    source: "Cross 1965")]
pub struct Cross {
    /// Viscosity η_0 at rest.
    #[parameter(unit: "Pa s", min: 0.0, source: "Cross 1965")]
    pub rest_viscosity: f64,
    /// Viscosity η_∞ at high strain rates.
    #[parameter(default, unit: "Pa s", min: 0.0, source: "Cross 1965")]
    pub infinite_viscosity: f64,
    /// Time λ: half the way at γ̇ = 1/λ.
    #[parameter(unit: "s", min: 0.0, source: "Cross 1965")]
    pub relaxation_time: f64,
    /// Exponent m.
    #[parameter(unit: "1", above: 0.0, source: "Cross 1965")]
    pub exponent: f64,
}

impl Cross {
    /// η at a strain rate, Pa s.
    pub fn at(&self, strain_rate: f64) -> f64 {
        let share = 1.0 / (1.0 + (self.relaxation_time * strain_rate).powf(self.exponent));
        self.rest_viscosity * share + self.infinite_viscosity * (1.0 - share)
    }
}

impl Rheology for Cross {
    fn needs(&self) -> Needs {
        Needs {
            strain_rate: self.uniform_viscosity().is_none(),
            pressure: false,
        }
    }
    fn uniform_viscosity(&self) -> Option<f64> {
        (self.rest_viscosity == self.infinite_viscosity).then_some(self.rest_viscosity)
    }
    fn viscosity(&self, inputs: &Inputs<'_>, viscosity: &mut [f64]) {
        for (k, eta) in viscosity.iter_mut().enumerate() {
            *eta = self.at(inputs.at(k).0);
        }
    }
    fn largest_viscosity(&self) -> f64 {
        self.rest_viscosity.max(self.infinite_viscosity)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ends_middle_and_slope_are_right() {
        let law = Cross {
            rest_viscosity: 10.0,
            infinite_viscosity: 0.1,
            relaxation_time: 2.0,
            exponent: 0.8,
        };
        assert_eq!(law.at(0.0), 10.0);
        assert!((law.at(0.5) - 5.05).abs() < 1e-14);
        let slope = ((law.at(2e9) - 0.1) / (law.at(1e9) - 0.1)).log2();
        assert!((slope + 0.8).abs() < 1e-6, "{slope}");
        assert!((law.at(1e300) - 0.1).abs() < 1e-14);
    }
}
