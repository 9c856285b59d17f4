//! The least and largest value of a field.

use sph_core::plugin;

use crate::ProbeEntry;
use crate::measure::{MeasuringProbe, Plan, PlannedColumn, Preset, Quantity, Reduce};

/// Smallest and largest value of a field, in its own unit; over `scale`, without one.
///
/// ```toml
/// [probe.deficit]
/// kind = "range"
/// field = "density_constant"
/// scale = 1000
/// ```
#[plugin(ProbeEntry [2, 3], "range", "smallest and largest value of a field", source: "plain extrema",
    within: MeasuringProbe::new)]
pub struct FieldRange {
    /// Name of the field.
    pub field: String,
    /// The values are divided by this, in the field's own unit; 1 leaves them as they are.
    #[parameter(default: 1.0, above: 0.0)]
    pub scale: f64,
}

impl Preset for FieldRange {
    fn plan(&self, _: usize) -> Plan<'_> {
        let column = |suffix, reduce| {
            let field = Quantity::Column(self.field.clone());
            PlannedColumn::new(suffix, field, reduce).over(self.scale)
        };
        Plan::of_phase(
            None,
            vec![column(".min", Reduce::Min), column(".max", Reduce::Max)],
        )
    }
}
