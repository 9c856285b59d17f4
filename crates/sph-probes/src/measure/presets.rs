//! Measurements that a scene composes itself, and those with names of their own: energies, volumes, extrema, fronts.

use std::collections::BTreeMap;

use sph_core::{Axis, fields, parameters, plugin};

use super::particles::AXES;
use super::plan::{MeasuringProbe, PlannedColumn, above, below};
use super::quantity::{Quantity, Reduce, Reduction};
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

    /// Its name in scenes.
    pub fn name(self) -> &'static str {
        Self::ALL[self as usize].1
    }

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
/// `levels = [0.05]` adds the highest place at which the values come up to 0.05, in the field's own unit: the surface of
/// a deposit or of a heated layer. The mean over the particles within a spacing counts, weighed with `weight` and
/// 1 − |Δz|/δr; it is linear between heights a quarter of a spacing apart. NaN where the values do not come up to it.
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
    source: "sums, extrema, quantiles", within: MeasuringProbe::from)]
pub struct Statistic {
    /// The quantity.
    pub field: String,
    /// Its reductions.
    #[parameter(default: vec![Reduction::Mean])]
    pub reduce: Vec<Reduction>,
    /// Shares q: a column for the least value that a share q of the weight does not exceed.
    #[parameter(default, unit: "1", min: 0.0, max: 1.0)]
    pub quantiles: Vec<f64>,
    /// Values of the quantity: a column for the highest place at which it comes up to each.
    #[parameter(default)]
    pub levels: Vec<f64>,
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
            Reduce::By(Reduction::Share) => column.in_units(["1"; 2]),
            Reduce::By(Reduction::Total) => column.in_units([self.weight.unit(); 2]),
            _ => column.over(self.scale),
        }
    }
}

impl From<Statistic> for MeasuringProbe {
    fn from(own: Statistic) -> Self {
        let count = own.reduce.len() + own.quantiles.len() + own.levels.len();
        let suffix = |name: String| match count {
            1 => String::new(),
            _ => format!(".{name}"),
        };
        let reduced = |how: &Reduction| own.column(&suffix(how.name().into()), (*how).into());
        let quantile = |q: &f64| own.column(&suffix(format!("q{q}")), Reduce::Quantile(*q));
        let reduced = own.reduce.iter().map(reduced);
        let quantiles = own.quantiles.iter().map(quantile);
        let level = |value: &f64| {
            let suffix = suffix(format!("level{value}"));
            PlannedColumn::new(&suffix, &own.field, Reduction::Mean).at_level(*value)
        };
        let levels = own.levels.iter().map(level);
        let columns: Vec<PlannedColumn> = reduced.chain(quantiles).chain(levels).collect();
        let above = own.above.iter().map(|(name, least)| above(name, *least));
        let below = own.below.iter().map(|(name, most)| below(name, *most));
        MeasuringProbe {
            conditions: above.chain(below).collect(),
            weight: match own.weight {
                Weight::One => None,
                weight => Some(Quantity::named(weight.name())),
            },
            slices: own.along.map(|axis| (axis as usize, own.slice)),
            fitted: own.fit.map(|axis| axis as usize),
            ..MeasuringProbe::of_phase(own.phase, columns)
        }
    }
}

/// ½ Σ m u² of all free particles, J (per metre of depth in 2D).
///
/// ```toml
/// [probe.energy]
/// kind = "kinetic-energy"
/// ```
#[plugin(ProbeEntry [2, 3], "kinetic-energy", "kinetic energy of all particles", source: "½ Σ m u²",
    within: MeasuringProbe::from)]
pub struct KineticEnergy {}

impl From<KineticEnergy> for MeasuringProbe {
    fn from(_: KineticEnergy) -> Self {
        let energy = PlannedColumn::new("", "kinetic_energy", Reduction::Sum);
        MeasuringProbe::of_phase(None, [energy])
    }
}

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
    within: MeasuringProbe::from)]
pub struct PhaseEnergy {
    /// Name of the phase; all particles if left out.
    pub phase: Option<String>,
}

impl From<PhaseEnergy> for MeasuringProbe {
    fn from(own: PhaseEnergy) -> Self {
        let kinds = [
            (".kinetic", "kinetic_energy"),
            (".potential", "potential_energy"),
        ];
        let sum = |(suffix, name)| PlannedColumn::new(suffix, name, Reduction::Sum);
        MeasuringProbe::of_phase(own.phase, kinds.map(sum))
    }
}

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
    within: MeasuringProbe::from)]
pub struct PhaseVolume {
    /// Name of the phase; all particles if left out.
    pub phase: Option<String>,
    /// The volume is divided by this, m² or m³.
    #[parameter(default: 1.0, above: 0.0)]
    pub scale: f64,
}

impl From<PhaseVolume> for MeasuringProbe {
    fn from(own: PhaseVolume) -> Self {
        let sum = PlannedColumn::new("", fields::VOLUME.name, Reduction::Sum);
        let sum = sum.in_units(["m²", "m³"]);
        MeasuringProbe::of_phase(own.phase, [sum.over(own.scale)])
    }
}

/// Smallest and largest value of a field, in its own unit; over `scale`, without one.
///
/// ```toml
/// [probe.deficit]
/// kind = "range"
/// field = "density_constant"
/// scale = 1000
/// ```
#[plugin(ProbeEntry [2, 3], "range", "smallest and largest value of a field", source: "plain extrema",
    within: MeasuringProbe::from)]
pub struct FieldRange {
    /// Name of the field.
    pub field: String,
    /// The values are divided by this, in the field's own unit; 1 leaves them as they are.
    #[parameter(default: 1.0, above: 0.0)]
    pub scale: f64,
}

impl From<FieldRange> for MeasuringProbe {
    fn from(own: FieldRange) -> Self {
        let ends = [(".min", Reduction::Min), (".max", Reduction::Max)];
        let column = |(suffix, end)| PlannedColumn::new(suffix, &own.field, end).over(own.scale);
        MeasuringProbe::of_phase(None, ends.map(column))
    }
}

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
    within: MeasuringProbe::from)]
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

impl From<Extent> for MeasuringProbe {
    fn from(own: Extent) -> Self {
        let (low, high, weight) = match own.quantile {
            0.0 => (Reduction::Min.into(), Reduction::Max.into(), None),
            share => {
                let volume = Some(Quantity::named(fields::VOLUME.name));
                (Reduce::FromBelow(share), Reduce::FromAbove(share), volume)
            }
        };
        let along = AXES[own.axis as usize];
        let lowest = PlannedColumn::new(".lowest", along, low).and_spacings(-0.5);
        let highest = PlannedColumn::new(".highest", along, high).and_spacings(0.5);
        MeasuringProbe {
            weight,
            ..MeasuringProbe::of_phase(own.phase, [lowest, highest])
        }
    }
}

/// One of the two ends of a phase along an axis.
#[parameters]
#[serde(rename_all = "lowercase")]
pub enum Direction {
    /// Towards larger coordinates.
    #[default]
    Forward,
    /// Towards smaller ones.
    Backward,
}

/// The largest coordinate of any particle plus half a spacing: the front of a surge.
///
/// With `direction = "backward"` it is the smallest coordinate less half a spacing. With `quantile` = q < 1 a share q
/// of the particles is behind it, and the others, which may have left the bulk, do not make a front.
///
/// ```toml
/// [probe.front]
/// kind = "front"
/// axis = "x"
/// below = 0.1
/// quantile = 0.995
/// ```
#[plugin(ProbeEntry [2, 3], "front", "the foremost particle along an axis, either way",
    source: "extreme coordinate or quantile, and half a spacing",
    within: MeasuringProbe::from)]
pub struct Front {
    /// Axis along which the front moves.
    #[parameter(default)]
    pub axis: Axis,
    /// Its direction along the axis.
    #[parameter(default)]
    pub direction: Direction,
    /// Share of the particles that the front is ahead of; all of them if left out.
    #[parameter(unit: "1", above: 0.0, max: 1.0)]
    pub quantile: Option<f64>,
    /// Only particles whose last coordinate is below this height count.
    #[parameter(unit: "m")]
    pub below: Option<f64>,
    /// Name of the phase whose front is measured; that of all particles if left out.
    pub phase: Option<String>,
}

impl From<Front> for MeasuringProbe {
    fn from(own: Front) -> Self {
        let share = own.quantile.unwrap_or(1.0);
        let (reduce, spacings) = match own.direction {
            Direction::Forward => (Reduce::Quantile(share), 0.5),
            Direction::Backward => (Reduce::QuantileDown(share), -0.5),
        };
        let front = PlannedColumn::new("", AXES[own.axis as usize], reduce).and_spacings(spacings);
        // The last coordinate in the plane, too.
        let lower = |height: f64| below("z", height);
        MeasuringProbe {
            conditions: own.below.map(lower).into_iter().collect(),
            ..MeasuringProbe::of_phase(own.phase, [front])
        }
    }
}

/// Share of the particles whose strain rate is above a threshold, γ̇ > γ̇_y, and the mean strain rate of those, 1/s.
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
    within: MeasuringProbe::from)]
pub struct Yielded {
    /// Threshold γ̇_y.
    #[parameter(unit: "1/s", min: 0.0)]
    pub strain_rate: f64,
    /// Name of the phase; all particles if left out.
    pub phase: Option<String>,
}

impl From<Yielded> for MeasuringProbe {
    fn from(own: Yielded) -> Self {
        let rate = fields::STRAIN_RATE.name;
        let columns = [
            PlannedColumn::new(".share", rate, Reduction::Share).in_units(["1"; 2]),
            PlannedColumn::new(".mean", rate, Reduction::Mean).in_units(["1/s"; 2]),
        ];
        MeasuringProbe {
            conditions: vec![above(rate, own.strain_rate)],
            ..MeasuringProbe::of_phase(own.phase, columns)
        }
    }
}
