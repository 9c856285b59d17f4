//! The volume of a phase.

use sph_core::{fields, plugin};

use crate::ProbeEntry;
use crate::measure::{MeasuringProbe, Plan, PlannedColumn, Preset, Quantity, Reduce};

/// Σ V over the particles of a phase, m² in two dimensions and m³ in three.
///
/// V = m/ρ: what a phase loses of it, it is compressed; what it gains, it has torn or swollen.
///
/// ```toml
/// [probe.air-volume]
/// kind = "phase-volume"
/// phase = "air"
/// scale = 0.786
/// ```
#[plugin(ProbeEntry [2, 3], "phase-volume", "volume of a phase", source: "Σ m/ρ",
    within: MeasuringProbe::new)]
pub struct PhaseVolume {
    /// Name of the phase; all particles if left out.
    pub phase: Option<String>,
    /// The volume is divided by this, m² or m³.
    #[parameter(default: 1.0, above: 0.0)]
    pub scale: f64,
}

impl Preset for PhaseVolume {
    fn plan(&self, dimension: usize) -> Plan<'_> {
        let unit = if dimension == 2 { "m²" } else { "m³" };
        let volume = Quantity::Column(fields::VOLUME.name.into());
        let sum = PlannedColumn::new("", volume, Reduce::Sum).in_unit(unit);
        Plan::of_phase(self.phase.as_deref(), vec![sum.over(self.scale)])
    }
}
