//! The energy of a phase.

use sph_core::plugin;

use crate::ProbeEntry;
use crate::measure::{MeasuringProbe, Plan, PlannedColumn, Preset, Quantity, Reduce};

/// Kinetic energy ½ Σ m u² and potential energy −Σ m g·r of a phase, J (per metre of depth in 2D).
///
/// The potential energy counts from the origin.
///
/// ```toml
/// [probe.water-energy]
/// kind = "phase-energy"
/// phase = "water"
/// ```
#[plugin(ProbeEntry [2, 3], "phase-energy", "kinetic and potential energy of a phase", source: "½ Σ m u², −Σ m g·r",
    within: MeasuringProbe::new)]
pub struct PhaseEnergy {
    /// Name of the phase; all particles if left out.
    pub phase: Option<String>,
}

impl Preset for PhaseEnergy {
    fn plan(&self, _: usize) -> Plan<'_> {
        let kinetic = PlannedColumn::new(".kinetic", Quantity::KineticEnergy, Reduce::Sum);
        let potential = PlannedColumn::new(".potential", Quantity::PotentialEnergy, Reduce::Sum);
        let columns = [kinetic, potential].map(|column| column.in_unit("J"));
        Plan::of_phase(self.phase.as_deref(), columns.into())
    }
}
