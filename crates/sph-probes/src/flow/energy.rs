//! Kinetic energy.

use sph_core::plugin;

use crate::ProbeEntry;
use crate::measure::{MeasuringProbe, Plan, PlannedColumn, Preset, Quantity, Reduce};

/// ½ Σ m u² of all free particles, J (per metre of depth in 2D).
///
/// ```toml
/// [probe.energy]
/// kind = "kinetic-energy"
/// ```
#[plugin(ProbeEntry [2, 3], "kinetic-energy", "kinetic energy of all particles", source: "½ Σ m u²",
    within: MeasuringProbe::new)]
pub struct KineticEnergy {}

impl Preset for KineticEnergy {
    fn plan(&self, _: usize) -> Plan<'_> {
        let energy = PlannedColumn::new("", Quantity::KineticEnergy, Reduce::Sum);
        Plan::of_phase(None, vec![energy.in_unit("J")])
    }
}
