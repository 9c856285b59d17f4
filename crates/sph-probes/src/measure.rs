//! Measurements that compose: a quantity of particles, the particles that count, and a reduction to numbers.

mod plan;
pub(crate) mod presets;
pub(crate) mod quantity;

pub use presets::Weight;
pub use quantity::{Reduce, Reduction, WeightedValues};
