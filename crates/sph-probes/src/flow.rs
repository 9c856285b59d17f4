//! Probes of the whole flow, and of places in it.

pub(crate) mod angular_momentum;
pub(crate) mod displacement;
pub(crate) mod energy_budget;
pub(crate) mod level;
pub(crate) mod mean_profile;
pub(crate) mod point;
pub(crate) mod profile;
pub(crate) mod spectrum;
pub(crate) mod stream_function;
pub(crate) mod walls;
