//! Velocities that die away: fluids that are to settle, and sponges that waves do not come back from.
//!
//! * [`Rayleigh`] is the plugin, `[damping.rayleigh]`; [`Zone`] is where it acts.
//! * [`DampingEntry`] is the kind, for plugins of other crates.

mod rayleigh;
mod zone;

pub use rayleigh::{DampingEntry, Rayleigh};
pub use zone::Zone;
