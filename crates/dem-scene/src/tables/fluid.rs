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
    /// Whether it shears between neighbours that slide past each other. Catalano 2012, Eqs. (6.29), (6.30).
    #[serde(default)]
    pub shear: bool,
    /// Lubrication of the gaps between neighbours; none if left out.
    pub lubrication: Option<Lubrication>,
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

/// F = 6 π µ a² (1/max(h, ε a) − 1/(c a)) v_n between neighbours with the gap h < c a, a = R₁ R₂/(R₁ + R₂).
#[derive(Clone, Copy, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Lubrication {
    /// Roughness ε in terms of a: no gap counts as narrower.
    #[serde(default = "hundredth")]
    #[schemars(extend("unit" = "1", "exclusiveMinimum" = 0.0))]
    pub roughness: f64,
    /// Range c in terms of a, beyond which the pores' pressures have to do.
    #[serde(default = "one")]
    #[schemars(extend("unit" = "1", "exclusiveMinimum" = 0.0))]
    pub range: f64,
}

fn one() -> f64 {
    1.0
}

fn hundredth() -> f64 {
    0.01
}
