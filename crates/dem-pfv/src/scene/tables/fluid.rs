//! The table `[fluid]`.

use sph_core::parameters;

use super::{AnyPlugins, Plugins};

/// The fluid that fills the pores of the box.
#[parameters]
pub struct Fluid {
    /// Dynamic viscosity µ, Pa s.
    #[parameter(unit: "Pa s", above: 0.0)]
    pub viscosity: f64,
    /// Density ρ_f, kg/m³, for buoyancy; zero for none.
    #[parameter(default, unit: "kg/m³", min: 0.0)]
    pub density: f64,
    /// Bulk modulus K_f, Pa; a fluid that does not give way if left out.
    #[parameter(unit: "Pa", above: 0.0)]
    pub bulk_modulus: Option<f64>,
    /// True if it shears between neighbours that slide past each other. Catalano 2012, Eqs. (6.29), (6.30).
    #[parameter(default)]
    pub shear: bool,
    /// Lubrication of the gaps between neighbours; none if left out.
    pub lubrication: Option<Lubrication>,
    /// Strain of a pore, summed over steps, at which pores are found anew. Catalano 2012, Eq. (5.14).
    #[parameter(default: 0.01, unit: "1", min: 0.0)]
    pub remesh_strain: f64,
    /// Steps after which they are found anew at any strain.
    #[parameter(min: 1)]
    pub remesh_steps: Option<u64>,
    /// The law for the conductance of throats, `[fluid.conductance.LAW]`; hydraulic radii if left out.
    #[parameter(default)]
    #[schemars(with = "AnyPlugins")]
    pub conductance: Plugins,
}

/// F = 6 π µ a² (1/max(h, ε a) − 1/(c a)) v_n between neighbours with the gap h < c a, a = R₁ R₂/(R₁ + R₂).
#[parameters]
pub struct Lubrication {
    /// Roughness ε in terms of a: no gap counts as narrower.
    #[parameter(default: 0.01, unit: "1", above: 0.0)]
    pub roughness: f64,
    /// Range c in terms of a, beyond which the pores' pressures have to do.
    #[parameter(default: 1.0, unit: "1", above: 0.0)]
    pub range: f64,
}
