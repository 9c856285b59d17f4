//! Probes of one phase.

pub(crate) mod interface;
pub(crate) mod line;
pub(crate) mod phase;
pub(crate) mod slope;
