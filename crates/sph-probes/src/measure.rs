//! Measurements that compose: a quantity of particles, the particles that count, and a reduction to numbers.

mod plan;
mod plugin;
pub(crate) mod presets;
pub(crate) mod quantity;
mod reduction;

pub use plugin::Weight;
pub use reduction::{Reduce, Reduction, WeightedValues};
