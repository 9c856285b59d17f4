//! The commands where the scene is one of grains.

pub mod check;
pub mod explain;
pub mod outcome;
