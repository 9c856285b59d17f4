//! From bodies to particles.

pub(crate) mod disorder;
pub(crate) mod estimate;
pub(crate) mod fill;
pub(crate) mod nodes;
