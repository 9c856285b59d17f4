//! Measurements that compose: a quantity of particles, the particles that count, and a reduction to numbers.

mod conditions;
mod plan;
mod plugin;
pub(crate) mod quantity;
mod reduction;

pub(crate) use conditions::QuantityBounds;
pub(crate) use plan::{MeasuringProbe, Plan, PlannedColumn, Preset};
pub use plugin::{Reduction, Statistic, Weight, quantile, reduced};
pub(crate) use quantity::Quantity;
pub(crate) use reduction::Reduce;
