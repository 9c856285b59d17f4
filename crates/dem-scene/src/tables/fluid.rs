//! The table `[fluid]`.

use schemars::JsonSchema;
use serde::Deserialize;

use super::{AnyPlugins, Plugins};

/// The fluid that fills the pores of the box.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Fluid {
    /// Dynamic viscosity µ, Pa s.
    #[schemars(extend("unit" = "Pa s", "exclusiveMinimum" = 0.0))]
    pub viscosity: f64,
    /// Density ρ_f, kg/m³, for buoyancy; zero for none.
    #[serde(default)]
    #[schemars(extend("unit" = "kg/m³", "minimum" = 0.0))]
    pub density: f64,
    /// Bulk modulus K_f, Pa; a fluid that does not give way if left out.
    #[schemars(extend("unit" = "Pa", "exclusiveMinimum" = 0.0))]
    pub bulk_modulus: Option<f64>,
    /// Strain of a pore, summed over steps, at which pores are found anew. Catalano 2012, Eq. (5.14).
    #[serde(default = "hundredth")]
    #[schemars(extend("unit" = "1", "minimum" = 0.0))]
    pub remesh_strain: f64,
    /// Steps after which they are found anew whatever the strain.
    #[schemars(range(min = 1))]
    pub remesh_steps: Option<u64>,
    /// The law for the conductance of throats, `[fluid.conductance.LAW]`; hydraulic radii if left out.
    #[serde(default)]
    #[schemars(with = "AnyPlugins")]
    pub conductance: Plugins,
}

fn hundredth() -> f64 {
    0.01
}
