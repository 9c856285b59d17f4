//! Probes of one phase.

pub(crate) mod extent;
pub(crate) mod interface;
pub(crate) mod line;
pub(crate) mod phase;
pub(crate) mod phase_energy;
pub(crate) mod phase_volume;
pub(crate) mod slope;
pub(crate) mod yielded;
