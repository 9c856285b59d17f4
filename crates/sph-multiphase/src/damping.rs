//! Decay of velocities: for fluids that are to settle, and sponges that absorb waves.
//!
//! * [`Rayleigh`] is the plugin, `[damping.rayleigh]`; [`Zone`] is where it acts.
//! * [`DampingEntry`] is the kind, for plugins of other crates.

mod rayleigh;
mod zone;

pub use rayleigh::{DampingEntry, Rayleigh};
pub use zone::Zone;
