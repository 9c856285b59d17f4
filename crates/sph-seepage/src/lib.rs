//! Water that moves through the pores of soils.
//!
//! [`Seepage`] is a kind of plugin; [`DarcyForchheimer`] is one, with the [`PoreResistance`] of grains of a size.
//! [`Seeping`] brings it into a scene.
#![doc = include_str!("../README.md")]

mod contract;
mod darcy_forchheimer;
mod exchange;
mod net;
mod pore_resistance;
mod pore_water;

pub use contract::{SEEPAGE_PRESSURE, SEEPAGE_VELOCITY, SeepageEntry};
pub use darcy_forchheimer::DarcyForchheimer;
pub use pore_resistance::PoreResistance;
