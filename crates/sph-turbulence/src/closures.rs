//! Closures without a history.

pub(crate) mod common;
mod filter;
mod last_strain;
pub(crate) mod length;
mod mixing_length;
pub(crate) mod phases;
mod smagorinsky;
mod wale;
mod wall_units;

pub use filter::FilterLength;
pub use mixing_length::MixingLength;
pub use smagorinsky::{Damping, Smagorinsky, StrainOf};
pub use wale::Wale;
