//! The table `[fluid]`.

use sph_core::parameters;

use super::{AnyPlugins, Plugins};
use crate::coupled;

/// The fluid that fills the pores of the box.
#[parameters]
pub struct Fluid {
    /// Its properties.
    #[serde(flatten)]
    pub given: coupled::Fluid,
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
