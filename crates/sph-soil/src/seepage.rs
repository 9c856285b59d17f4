//! Water that moves through the pores of soils.
//!
//! [`DarcyForchheimer`] is a plugin of the kind `seepage`, with the [`PoreResistance`] of grains of a size.

mod contract;
mod darcy_forchheimer;
mod exchange;
mod net;
mod pore_resistance;
mod pore_water;

pub use contract::{SEEPAGE_PRESSURE, SEEPAGE_VELOCITY, SeepageEntry};
pub use darcy_forchheimer::DarcyForchheimer;
pub(crate) use exchange::{Exchange, Gains};
pub(crate) use net::Phase;
pub use pore_resistance::PoreResistance;
