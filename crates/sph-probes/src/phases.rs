//! Probes of one phase.

pub(crate) mod level;
pub(crate) mod phase;
