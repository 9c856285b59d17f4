//! Extent of a phase along an axis.

use sph_core::{Axis, fields, plugin};

use crate::ProbeEntry;
use crate::measure::{MeasuringProbe, Plan, PlannedColumn, Preset, Quantity, Reduce};

/// Least coordinate of a phase less half a spacing, and largest plus half a spacing, m.
///
/// With `quantile` = q > 0 they are the places below and above which a share q of the phase's
/// volume lies: a few particles that have left the bulk do not count.
///
/// ```toml
/// [probe.bubble]
/// kind = "extent"
/// phase = "light"
/// axis = "y"
/// ```
#[plugin(ProbeEntry [2, 3], "extent", "lowest and highest coordinate of a phase",
    source: "extrema or quantiles, and half a spacing",
    within: MeasuringProbe::new)]
pub struct Extent {
    /// Name of the phase; all particles if left out.
    pub phase: Option<String>,
    /// The axis.
    #[parameter(default)]
    pub axis: Axis,
    /// Share of the volume that is left out at either end.
    #[parameter(default, unit: "1", min: 0.0, below: 0.5)]
    pub quantile: f64,
}

impl Preset for Extent {
    fn plan(&self, _: usize) -> Plan<'_> {
        let (low, high, weight) = match self.quantile {
            0.0 => (Reduce::Min, Reduce::Max, None),
            share => {
                let volume = Quantity::Column(fields::VOLUME.name.into());
                (
                    Reduce::FromBelow(share),
                    Reduce::FromAbove(share),
                    Some(volume),
                )
            }
        };
        let along = || Quantity::Coordinate(self.axis as usize);
        let lowest = PlannedColumn::new(".lowest", along(), low).and_spacings(-0.5);
        let highest = PlannedColumn::new(".highest", along(), high).and_spacings(0.5);
        let columns = [lowest, highest].map(|column| column.in_unit("m"));
        Plan {
            weight,
            ..Plan::of_phase(self.phase.as_deref(), columns.into())
        }
    }
}
