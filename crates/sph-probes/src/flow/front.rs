//! The foremost particle.

use sph_core::{Axis, parameters, plugin};

use crate::ProbeEntry;
use crate::measure::{
    MeasuringProbe, Plan, PlannedColumn, Preset, Quantity, QuantityBounds, Reduce,
};

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
/// With `direction = "backward"` it is the smallest coordinate less half a spacing. With
/// `quantile` = q < 1 a share q of the particles is behind it, and the others, which may have left
/// the bulk, do not make a front.
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
    within: MeasuringProbe::new)]
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

impl Preset for Front {
    fn plan(&self, dimension: usize) -> Plan<'_> {
        let share = self.quantile.unwrap_or(1.0);
        let (reduce, spacings) = match self.direction {
            Direction::Forward => (Reduce::Quantile(share), 0.5),
            Direction::Backward => (Reduce::QuantileDown(share), -0.5),
        };
        let along = Quantity::Coordinate(self.axis as usize);
        let front = PlannedColumn::new("", along, reduce).and_spacings(spacings);
        let upright = || Quantity::Coordinate(dimension - 1);
        let below = self
            .below
            .map(|height| QuantityBounds::below(upright(), height));
        Plan {
            conditions: below.into_iter().collect(),
            ..Plan::of_phase(self.phase.as_deref(), vec![front.in_unit("m")])
        }
    }
}
