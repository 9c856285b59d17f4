//! Soils that change their packing as they shear.
//!
//! [`Dilatancy`] is a kind of plugin: the rate at which grains at a packing, a strain rate and a pressure expand, and the
//! friction that goes with it. [`RouxRadjai`] and [`PlasticPressure`] share a [`CriticalState`]; they differ in the place at
//! which dilation acts. The packing itself is a column of [`pores`](crate::pores).

mod critical_state;
mod plugins;

pub use critical_state::{CriticalState, Dilation, Equilibrium, GrainState};
pub use plugins::{Dilatancy, DilatancyEntry, PlasticPressure, RouxRadjai};
