//! Pores through which a fluid passes freely.

use std::collections::BTreeMap;

use sph_core::plugin;

use super::contract::{PoreModel, PorePressureEntry, PoreSettings};

/// φ̇ = −φ γ̇ tan ψ: dry soils, or soils so coarse that no excess pressure builds up.
///
/// Source: Roux and Radjai 1998.
///
/// ```toml
/// [pore-pressure.drained]
/// soil = "sand"
/// porosity = 0.42
/// ```
#[plugin(PorePressureEntry, "drained", "packing as a state, pores without excess pressure",
    source: "Roux and Radjai 1998", cfg(not(test)))]
pub struct Drained {
    /// Name of the phase with the pores.
    pub soil: String,
    /// Porosity n = 1 − φ of the soil at the start.
    #[parameter(unit: "1", above: 0.0, below: 1.0)]
    pub porosity: f64,
    /// Porosities of single bodies at the start, by the names of the bodies.
    #[parameter(default, unit: "1", above: 0.0, below: 1.0)]
    pub bodies: BTreeMap<String, f64>,
    /// Density of the fluid that goes in and out; 0 for dry pores.
    #[parameter(default, unit: "kg/m³", min: 0.0)]
    pub fluid_density: f64,
    /// True if particles grow and shrink with their packing.
    #[parameter(default: true)]
    pub swelling: bool,
}

impl PoreModel for Drained {
    fn settings(&self) -> PoreSettings {
        PoreSettings {
            soil: self.soil.clone(),
            water: None,
            porosity: self.porosity,
            bodies: self.bodies.clone(),
            fluid_density: Some(self.fluid_density),
            swelling: self.swelling,
            skeleton: None,
        }
    }
}
