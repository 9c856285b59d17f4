//! Pressure from the end of the step.
//!
//! * [`ImplicitPressure`] is the plugin, `[pressure.implicit]`, of the kind that
//!   [`PressureScheme`](sph_multiphase::PressureScheme) is.
#![doc = include_str!("../README.md")]

mod bodies;
mod implicit;
mod limit;
mod stage;
mod system;

pub use implicit::ImplicitPressure;
pub use limit::FlowLimit;
