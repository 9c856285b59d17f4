//! From bodies to particles.

pub(crate) mod disorder;
pub(crate) mod fill;
