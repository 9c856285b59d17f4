//! Closures with transported scalars: k with a length, k–ε.

mod diffusion;
mod k_length;
mod model;
mod plugin;
mod start;
mod work;

pub use k_length::KLength;
pub use model::KEpsilonModel;
pub use plugin::KEpsilon;
pub use start::ChannelStart;
