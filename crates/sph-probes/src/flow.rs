//! Probes of the whole flow, and of places in it.

pub(crate) mod energy_budget;
mod grids;
mod mean_profile;
pub(crate) mod point;
pub(crate) mod profile;
mod walls;
