//! Motion of walls: courses over time, movers, and the state of a rigid wall.

pub(crate) mod motion;
#[cfg(feature = "plugins")]
pub(crate) mod mover;
pub(crate) mod pose;
#[cfg(feature = "plugins")]
pub(crate) mod rigid_state;
