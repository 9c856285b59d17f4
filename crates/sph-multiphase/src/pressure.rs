//! Pressure from the end of the step.
//!
//! * [`ImplicitPressure`] is the plugin, `[pressure.implicit]`, of the kind that
//!   [`PressureScheme`](crate::PressureScheme) is.

mod bodies;
mod implicit;
mod stage;
mod system;

pub use implicit::ImplicitPressure;
