//! The Carreau fluid.

use crate::{Inputs, Needs, Rheology, plugin};

/// η = η_∞ + (η_0 − η_∞) [1 + (λγ̇)^a]^((n−1)/a), between η_0 at rest and η_∞ at high strain rates.
///
/// Source: Carreau 1972 (a = 2), Yasuda et al. 1981 (any a).
///
/// ```toml
/// [phase.blood.rheology.carreau]
/// rest_viscosity = "56 mPa s"
/// infinite_viscosity = "3.45 mPa s"
/// relaxation_time = "3.313 s"
/// exponent = 0.3568
/// ```
#[plugin(crate::RheologyEntry, "carreau", "plateau at rest, then a power of the strain rate, then another plateau",
    source: "Carreau 1972")]
pub struct Carreau {
    /// Viscosity η_0 at rest.
    #[parameter(unit: "Pa s", min: 0.0, source: "Carreau 1972")]
    pub rest_viscosity: f64,
    /// Viscosity η_∞ at high strain rates.
    #[parameter(default, unit: "Pa s", min: 0.0, source: "Carreau 1972")]
    pub infinite_viscosity: f64,
    /// Time λ: thinning starts at γ̇ = 1/λ.
    #[parameter(unit: "s", min: 0.0, source: "Carreau 1972")]
    pub relaxation_time: f64,
    /// Exponent n of the power law in between.
    #[parameter(unit: "1", above: 0.0, max: 1.0, source: "Carreau 1972")]
    pub exponent: f64,
    /// Sharpness of the plateau's end, a.
    #[parameter(default: 2.0, unit: "1", above: 0.0, source: "Yasuda et al. 1981")]
    pub sharpness: f64,
}

impl Carreau {
    /// η at a strain rate, Pa s.
    pub fn at(&self, strain_rate: f64) -> f64 {
        let a = self.sharpness;
        let base = 1.0 + (self.relaxation_time * strain_rate).powf(a);
        let share = base.powf((self.exponent - 1.0) / a);
        self.rest_viscosity * share + self.infinite_viscosity * (1.0 - share)
    }
}

impl Rheology for Carreau {
    fn needs(&self) -> Needs {
        Needs {
            strain_rate: self.uniform_viscosity().is_none(),
            pressure: false,
        }
    }
    fn uniform_viscosity(&self) -> Option<f64> {
        let newtonian = self.exponent == 1.0 || self.rest_viscosity == self.infinite_viscosity;
        newtonian.then_some(self.rest_viscosity)
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
    fn plateau_and_power_are_right() {
        let law = Carreau {
            rest_viscosity: 56e-3,
            infinite_viscosity: 0.0,
            relaxation_time: 3.313,
            exponent: 0.3568,
            sharpness: 2.0,
        };
        assert_eq!(law.at(0.0), 56e-3);
        let slope = (law.at(2e6) / law.at(1e6)).log2();
        assert!((slope - (0.3568 - 1.0)).abs() < 1e-12, "{slope}");
        let half = 56e-3 * 2.0_f64.powf((0.3568 - 1.0) / 2.0);
        assert!((law.at(1.0 / 3.313) / half - 1.0).abs() < 1e-14);
    }
}
