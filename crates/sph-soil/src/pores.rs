//! Packing of soils, and the excess pressure of the fluid in their pores.
//!
//! * [`Darcy`] and [`Drained`] are plugins of the kind `pore-pressure`. Both carry the packing φ of one soil as the column
//!   [`PACKING`]; `Darcy` solves for the [`EXCESS_PORE_PRESSURE`] p_e in every step.
//! * The effective pressure becomes p' = p'_d − p_e, with the [`DRAINED_PRESSURE`] p'_d of the kind `effective-pressure`.
//! * A soil that expands takes up fluid, from the particles of the fluid at its surface or from one that is left out.

mod columns;
mod contribution;
mod drainage;
mod effective;
mod plugins;
mod pore_flow;
mod surface;
mod swelling;

pub(crate) use columns::PhaseMask;
pub use columns::{DRAINED_PRESSURE, EXCESS_PORE_PRESSURE, FRICTION_PRESSURE, PACKING};
pub use plugins::{Darcy, Drained, PoreModel, PorePressureEntry, PoreSettings, Supply};
