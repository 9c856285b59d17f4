//! Cells, lists of candidates, and pairs that walls hide.

pub(crate) mod buffer;
pub(crate) mod clusters;
pub(crate) mod grid;
pub(crate) mod half;
pub(crate) mod hidden;
pub(crate) mod members;
pub(crate) mod nearby;
