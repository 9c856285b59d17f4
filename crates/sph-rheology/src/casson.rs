//! The Casson fluid.

use crate::{Inputs, Needs, Rheology, plugin};

/// √τ = √τ_y + √(η_∞ γ̇) above the yield stress τ_y, rigid below it; regularised:
/// η = [√η_∞ + √(τ_y/γ̇) (1 − e^(−√(mγ̇)))]².
///
/// At rest η = (√η_∞ + √(τ_y m))². Blood and chocolate are described so.
///
/// Source: Casson 1959, with the growth of Papanastasiou 1987.
///
/// ```toml
/// [phase.blood.rheology.casson]
/// viscosity = "3.5 mPa s"
/// yield_stress = "4 mPa"
/// stress_growth = "100 s"
/// ```
#[plugin(crate::RheologyEntry, "casson", "roots of stresses add up: yield and viscous", source: "Casson 1959")]
pub struct Casson {
    /// Viscosity η_∞ at high strain rates.
    #[parameter(unit: "Pa s", min: 0.0, source: "Casson 1959")]
    pub viscosity: f64,
    /// Yield stress τ_y.
    #[parameter(unit: "Pa", min: 0.0, source: "Casson 1959")]
    pub yield_stress: f64,
    /// Stress growth time m.
    #[parameter(unit: "s", above: 0.0, source: "Papanastasiou 1987")]
    pub stress_growth: f64,
}

impl Casson {
    /// η at a strain rate, Pa s.
    pub fn at(&self, strain_rate: f64) -> f64 {
        let m = self.stress_growth;
        let growth = crate::regularisation::saturation((m * strain_rate).sqrt());
        (self.viscosity.sqrt() + (self.yield_stress * m).sqrt() * growth).powi(2)
    }
}

impl Rheology for Casson {
    fn needs(&self) -> Needs {
        Needs {
            strain_rate: self.yield_stress > 0.0,
            pressure: false,
        }
    }
    fn uniform_viscosity(&self) -> Option<f64> {
        (self.yield_stress <= 0.0).then_some(self.viscosity)
    }
    fn viscosity(&self, inputs: &Inputs<'_>, viscosity: &mut [f64]) {
        for (k, eta) in viscosity.iter_mut().enumerate() {
            *eta = self.at(inputs.at(k).0);
        }
    }
    fn largest_viscosity(&self) -> f64 {
        self.uniform_viscosity().unwrap_or_else(|| self.at(0.0))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_roots_of_the_stresses_add_up() {
        let law = Casson {
            viscosity: 3.5e-3,
            yield_stress: 4e-3,
            stress_growth: 100.0,
        };
        for rate in [50.0_f64, 1e3] {
            let stress: f64 = law.at(rate) * rate;
            let root = 4e-3_f64.sqrt() + (3.5e-3 * rate).sqrt();
            assert!((stress.sqrt() / root - 1.0).abs() < 1e-13, "{rate}");
        }
        let rest = (3.5e-3_f64.sqrt() + 0.4_f64.sqrt()).powi(2);
        assert!((law.at(0.0) / rest - 1.0).abs() < 1e-14);
        assert!((law.at(1e-20) / rest - 1.0).abs() < 1e-8);
    }
}
