//! Particles, places and pairs in lanes.

pub(crate) mod lane_pair;
pub(crate) mod lane_vector;
pub(crate) mod particles;
pub(crate) mod separation;
