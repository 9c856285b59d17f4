//! Closures with transported scalars: k with a length, k–ε.

mod diffusion;
mod earsm;
mod k_length;
mod model;
mod plugin;
mod realisable;
mod work;

pub use earsm::{AlgebraicStress, Anisotropy};
pub use k_length::KLength;
pub use model::{KEpsilonModel, Variant};
pub use plugin::{ChannelStart, KEpsilon};
pub use realisable::RealisableModel;
pub use work::AtWall;
