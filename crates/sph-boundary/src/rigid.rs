//! Motion of walls: courses over time, movers, and the state of a rigid wall.

pub(crate) mod bend;
pub(crate) mod load;
pub(crate) mod motion;
pub(crate) mod mover;
pub(crate) mod pose;
pub(crate) mod rigid_state;
pub(crate) mod spring;
