//! Share of a phase that has yielded.

use sph_core::{fields, plugin};

use crate::ProbeEntry;
use crate::measure::{
    MeasuringProbe, Plan, PlannedColumn, Preset, Quantity, QuantityBounds, Reduce,
};

/// Share of the particles whose strain rate is above a threshold, γ̇ > γ̇_y, and the mean strain
/// rate of those, 1/s.
///
/// A regularised law has no plug that does not move at all: the definition of yielding is a choice. A
/// phase without particles has no share, and without one that yields there is no mean: NaN. Only
/// scenes with a law that reads the strain rate have one; the probe computes it in all phases.
///
/// Source: ours.
///
/// ```toml
/// [probe.sliding]
/// kind = "yielded"
/// phase = "sand"
/// strain_rate = 1.0
/// ```
#[plugin(ProbeEntry [2, 3], "yielded", "share of a phase that strains faster than a threshold", source: "a count",
    within: MeasuringProbe::new)]
pub struct Yielded {
    /// Threshold γ̇_y.
    #[parameter(unit: "1/s", min: 0.0)]
    pub strain_rate: f64,
    /// Name of the phase; all particles if left out.
    pub phase: Option<String>,
}

impl Preset for Yielded {
    fn plan(&self, _: usize) -> Plan<'_> {
        let rate = || Quantity::Column(fields::STRAIN_RATE.name.into());
        let columns = vec![
            PlannedColumn::new(".share", rate(), Reduce::Share).in_unit("1"),
            PlannedColumn::new(".mean", rate(), Reduce::Mean).in_unit("1/s"),
        ];
        Plan {
            conditions: vec![QuantityBounds::above(rate(), self.strain_rate)],
            ..Plan::of_phase(self.phase.as_deref(), columns)
        }
    }
}
