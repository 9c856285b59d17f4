//! Bodies, frames and tanks that move.
