//! Laws from outside: `[phase.NAME.rheology.syrup]`, and `powell-eyring`, which reads the strain rate.

mod powell_eyring;

pub use powell_eyring::PowellEyring;
use sph_core::plugin;
use sph_rheology::{Inputs, Needs, Rheology, RheologyEntry};

/// τ = 2 η γ̇ with constant η, under another name.
#[plugin(RheologyEntry, "syrup", "constant viscosity", source: "breakfast")]
struct Syrup {
    /// Dynamic viscosity.
    #[parameter(unit: "Pa s", min: 0.0)]
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
