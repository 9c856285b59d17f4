//! Laws from outside: `[phase.NAME.rheology.syrup]`, and `powell-eyring`, which reads the strain rate.

mod powell_eyring;

pub use powell_eyring::PowellEyring;
use schemars::JsonSchema;
use serde::Deserialize;
use sph_core::register;
use sph_rheology::{Inputs, Needs, Rheology, RheologyEntry};

/// τ = 2 η γ̇ with constant η, under another name.
#[derive(Clone, Copy, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct Syrup {
    /// Dynamic viscosity.
    #[schemars(range(min = 0.0), extend("unit" = "Pa s"))]
    thickness: f64,
}

impl Rheology for Syrup {
    fn needs(&self) -> Needs {
        Needs::default()
    }
    fn uniform_viscosity(&self) -> Option<f64> {
        Some(self.thickness)
    }
    fn viscosity(&self, _inputs: &Inputs<'_>, viscosity: &mut [f64]) {
        viscosity.fill(self.thickness);
    }
    fn largest_viscosity(&self) -> f64 {
        self.thickness
    }
}

register!(
    RheologyEntry,
    Syrup,
    "syrup",
    "constant viscosity",
    "breakfast"
);
