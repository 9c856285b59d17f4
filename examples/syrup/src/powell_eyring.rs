//! A law that reads the strain rate: `[phase.NAME.rheology.powell-eyring]`.

use sph_core::plugin;
use sph_rheology::{Inputs, Needs, Rheology, RheologyEntry};

/// η = η_∞ + (η_0 − η_∞) arsinh(λγ̇)/(λγ̇), from η_0 at rest towards η_∞ at high strain rates.
#[plugin(RheologyEntry, "powell-eyring", "thins with the strain rate", source: "Powell & Eyring 1944")]
pub struct PowellEyring {
    /// Viscosity η_0 at rest.
    #[parameter(unit: "Pa s", min: 0.0)]
    pub rest_viscosity: f64,
    /// Viscosity η_∞ at high strain rates.
    #[parameter(default, unit: "Pa s", min: 0.0)]
    pub infinite_viscosity: f64,
    /// Time λ.
    #[parameter(unit: "s", min: 0.0)]
    pub relaxation_time: f64,
}

impl Rheology for PowellEyring {
    fn needs(&self) -> Needs {
        Needs {
            strain_rate: true,
            pressure: false,
        }
    }
    fn uniform_viscosity(&self) -> Option<f64> {
        None
    }
    fn viscosity(&self, inputs: &Inputs<'_>, viscosity: &mut [f64]) {
        for (eta, rate) in viscosity.iter_mut().zip(inputs.strain_rate) {
            let x = self.relaxation_time * rate;
            // Its limit at rest, where the quotient is 0/0.
            let share = if x > 1e-4 { x.asinh() / x } else { 1.0 };
            *eta =
                self.infinite_viscosity + (self.rest_viscosity - self.infinite_viscosity) * share;
        }
    }
    fn largest_viscosity(&self) -> f64 {
        self.rest_viscosity.max(self.infinite_viscosity)
    }
}
