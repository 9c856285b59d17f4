//! A law that reads the strain rate: `[phase.NAME.rheology.powell-eyring]`.

use schemars::JsonSchema;
use serde::Deserialize;
use sph_core::register;
use sph_rheology::{Inputs, Needs, Rheology, RheologyEntry};

/// η = η_∞ + (η_0 − η_∞) arsinh(λγ̇)/(λγ̇), from η_0 at rest towards η_∞ at high strain rates.
#[derive(Clone, Copy, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct PowellEyring {
    /// Viscosity η_0 at rest.
    #[schemars(range(min = 0.0), extend("unit" = "Pa s"))]
    pub rest_viscosity: f64,
    /// Viscosity η_∞ at high strain rates.
    #[serde(default)]
    #[schemars(range(min = 0.0), extend("unit" = "Pa s"))]
    pub infinite_viscosity: f64,
    /// Time λ.
    #[schemars(range(min = 0.0), extend("unit" = "s"))]
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

register!(
    RheologyEntry,
    PowellEyring,
    "powell-eyring",
    "thins with the strain rate",
    "Powell & Eyring 1944"
);
