//! Equations of state: pressure from density, on slices.
//!
//! * [`EquationOfState`] is a kind of plugin: [`Tait`], [`Linear`], and [`CompressibleGrains`], whose pressure follows
//!   the strain rate as well. [`BoundState`] is one with the reference state of a phase, [`Laws`] those of a scene.

mod compressible_grains;
mod eos;
mod tait;

pub use compressible_grains::CompressibleGrains;
#[cfg(feature = "plugins")]
pub use eos::EquationOfStateEntry;
pub use eos::{BoundState, EquationOfState, Laws, Lift, Lifted, Reference};
pub use tait::{Linear, Tait};
