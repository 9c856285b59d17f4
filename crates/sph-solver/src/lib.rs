//! Assembles the plugins a scene names into a plan, and steps it.
//!
//! The solver has traits and the registry, and no concrete kernel, wall, rheology, formulation, integrator, probe or
//! solution: names come from the scene, or from the kind of plugin where the scene is silent.
//!
//! * [`setup`]: names → plugins → stages in order, terms, step limits. `sph-particles` gives them particles and walls.
//! * [`Flow`]: one evaluation, one step; a [`sph_core::System`] for the integrator. `sph-particles` takes the steps of a run.
//! * [`rheometer`]: a law by its name, sheared alone; [`kernels`]: a kernel by its name.

// Plugins that are found by their names: a binary with the solver has them.
use sph_multiphase as _;
use sph_soil as _;

mod error;
pub mod kernels;
pub mod rheometer;
pub mod setup;
pub mod step;

pub use error::SolverError;
pub use sph_contribution::PluginInForce;
pub use step::{Flow, OutletTotals, Snapshot};
