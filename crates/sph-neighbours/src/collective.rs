//! Sums and solves with the particles of all ranks.

pub(crate) mod exchange;
pub(crate) mod owned;
pub(crate) mod space;
pub(crate) mod sums;
