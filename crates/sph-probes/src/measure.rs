//! Measurements that compose: a quantity of particles, the particles that count, and a reduction to numbers.

pub(crate) mod level;
pub(crate) mod particles;
mod plan;
pub(crate) mod presets;
pub(crate) mod quantity;

pub use particles::{MeasuredParticles, Values};
pub use plan::MeasuringProbe;
pub use presets::{Statistic, Weight};
pub use quantity::{Quantity, Reduce, Reduction, WeightedValues};
