//! Closures without a history.

pub(crate) mod behind;
mod filter;
pub(crate) mod length;
mod mixing_length;
pub(crate) mod phases;
mod smagorinsky;
mod wale;
mod wall_units;

pub use filter::FilterLength;
pub use mixing_length::MixingLength;
pub use smagorinsky::{Damping, Smagorinsky};
pub use wale::Wale;
