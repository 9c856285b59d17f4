//! A measurement that a scene composes itself.

use std::collections::BTreeMap;

use sph_core::{Axis, parameters, plugin};

use super::plan::{MeasuringProbe, Plan, PlannedColumn, Preset, above, below};
use super::quantity::Quantity;
use super::reduction::{Reduce, Reduction};
use crate::ProbeEntry;

/// The weight of a particle.
#[parameters]
#[derive(Copy, PartialEq)]
#[serde(rename_all = "lowercase")]
pub enum Weight {
    /// One.
    #[default]
    One,
    /// Its mass.
    Mass,
    /// Its volume.
    Volume,
}

impl Weight {
    /// All of them, with their names in scenes.
    pub const ALL: [(Weight, &'static str); 3] = [
        (Weight::One, "one"),
        (Weight::Mass, "mass"),
        (Weight::Volume, "volume"),
    ];

    /// Its unit.
    pub fn unit(self) -> &'static str {
        ["1", "kg", "m³"][self as usize]
    }
}

/// Any field over any particles, reduced to numbers: one column for each reduction.
///
/// The particles that count are those of `phase` whose quantities lie between the bounds `above` and `below`: a box is
/// `above = { x = 0.1 }, below = { x = 0.2, y = 0.05 }`, what has yielded `above = { strain_rate = 1 }`. A quantity
/// is a column (`pressure`; of a vector or tensor its magnitude), a component (`velocity.x`), a coordinate (`x`, `y`,
/// `z`), or one of `speed`, `kinetic_energy` and `potential_energy`. Bounds and values are in SI units.
///
/// `fit = "x"` adds slope and root mean square distance of the line through the values over that coordinate. `along =
/// "y"` writes the columns as curves over slices across that axis, with every output of fields.
///
/// ```toml
/// [probe.wave-crest]
/// kind = "statistic"
/// field = "y"
/// reduce = ["max", "mean"]
/// quantiles = [0.99]
/// phase = "water"
/// above = { x = 0.5 }
/// ```
#[plugin(ProbeEntry [2, 3], "statistic", "any field over any particles, reduced to numbers",
    source: "sums, extrema, quantiles", within: MeasuringProbe::new)]
pub struct Statistic {
    /// The quantity.
    pub field: String,
    /// Its reductions.
    #[parameter(default: vec![Reduction::Mean])]
    pub reduce: Vec<Reduction>,
    /// Shares q: a column for the least value that a share q of the weight does not exceed.
    #[parameter(default, unit: "1", min: 0.0, max: 1.0)]
    pub quantiles: Vec<f64>,
    /// The weight of a particle.
    #[parameter(default)]
    pub weight: Weight,
    /// Name of the phase; all particles if left out.
    pub phase: Option<String>,
    /// Lower bounds on quantities, in SI units.
    #[parameter(default)]
    pub above: BTreeMap<String, f64>,
    /// Upper bounds on quantities, in SI units.
    #[parameter(default)]
    pub below: BTreeMap<String, f64>,
    /// The axis along which a line is fitted to the values.
    pub fit: Option<Axis>,
    /// The axis along which the columns are written as curves.
    pub along: Option<Axis>,
    /// Width of the slices of such curves, in spacings.
    #[parameter(default: 2.0, unit: "1", above: 0.0)]
    pub slice: f64,
    /// The values are divided by this, in the field's own unit.
    #[parameter(default: 1.0, above: 0.0)]
    pub scale: f64,
}

impl Statistic {
    fn column(&self, suffix: &str, reduce: Reduce) -> PlannedColumn {
        let column = PlannedColumn::new(suffix, &self.field, reduce);
        match reduce {
            Reduce::By(Reduction::Share) => column.in_unit("1"),
            Reduce::By(Reduction::Total) => column.in_unit(self.weight.unit()),
            _ => column.over(self.scale),
        }
    }
}

impl Preset for Statistic {
    fn plan(&self, _: usize) -> Plan<'_> {
        let count = self.reduce.len() + self.quantiles.len();
        let suffix = |name: String| match count {
            1 => String::new(),
            _ => format!(".{name}"),
        };
        let reduced = |how: &Reduction| self.column(&suffix(how.name().into()), (*how).into());
        let quantile = |q: &f64| self.column(&suffix(format!("q{q}")), Reduce::Quantile(*q));
        let reduced = self.reduce.iter().map(reduced);
        let columns = reduced.chain(self.quantiles.iter().map(quantile));
        let above = self.above.iter().map(|(name, least)| above(name, *least));
        let below = self.below.iter().map(|(name, most)| below(name, *most));
        Plan {
            conditions: above.chain(below).collect(),
            weight: match self.weight {
                Weight::One => None,
                other => Some(Quantity::named(Weight::ALL[other as usize].1)),
            },
            slices: self.along.map(|axis| (axis as usize, self.slice)),
            fitted: self.fit.map(|axis| axis as usize),
            ..Plan::of_phase(self.phase.as_deref(), columns.collect::<Vec<_>>())
        }
    }
}
