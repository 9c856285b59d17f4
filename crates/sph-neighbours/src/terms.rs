//! Pair terms, and the sweep that sums them.

pub(crate) mod rates;
pub(crate) mod shares;
pub(crate) mod sweep;
pub(crate) mod term;
