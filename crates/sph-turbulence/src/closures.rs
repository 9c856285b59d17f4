//! Closures without a history.

mod common;
mod mixing_length;
mod phases;
mod smagorinsky;
mod wale;
mod wall_units;

pub(crate) use common::{ClosureCommon, rubs};
pub(crate) use mixing_length::Length;
pub use mixing_length::MixingLength;
pub(crate) use phases::{KIND, Kinematic, acts_on, viscosities};
pub use smagorinsky::{Damping, FilterLength, Smagorinsky, StrainOf};
pub use wale::Wale;
pub(crate) use wale::in_space;
