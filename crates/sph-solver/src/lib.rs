//! Assembles the plugins a scene names into a plan, and runs it.
//!
//! The solver knows traits and the registry, never a concrete kernel, wall, rheology,
//! formulation, integrator, probe or solution: names come from the scene, or from
//! [`defaults`] where the scene is silent.
//!
//! * [`assemble()`]: scene → [`Flow`]: columns, stages in order, step limits.
//! * [`Flow`]: one evaluation, one step; a [`sph_core::System`] for the integrator.
//! * [`run()`]: steps, outputs, checkpoints, roll-back, references, summary.
//! * [`run_part()`]: the same on one of several ranks, with a part of the particles.
//! * [`Stepper`]: the same in memory, step by step, with columns that may be changed in between.
//! * [`examine()`]: the numbers that follow from a scene, without running it.
//! * [`rheometer`]: a law by its name, sheared alone; [`kernels`]: a kernel by its name.

// Plugins of contributions alone, which the solver knows by their kinds.
use sph_diffusion as _;
use sph_seepage as _;

pub mod defaults;
mod failure;
pub mod kernels;
mod results;
pub mod rheometer;
mod running;
mod setup;
mod step;

pub use failure::error::{Failure, SolverError};
pub use failure::findings::{Findings, Share, Sighting, Suspect};
pub use failure::trouble::Trouble;
pub use results::scene_picture::draw_scene;
pub use results::summary::{Drift, ErrorEntry, RankShare, Status, Summary};
pub use running::driver::{Command, Observer, Progress};
pub use running::identity::{FileMark, Identity, marks};
pub use running::on_threads::run_on_threads;
pub use running::options::{RunOptions, Start};
pub use running::run::{run, run_part};
pub use running::stepper::Stepper;
pub use running::trial::Trial;
pub use setup::assemble::Assembled;
pub use setup::dimensions::assemble;
pub use setup::estimate::{Estimate, Size, size};
pub use setup::examination::{Examination, FieldUse, StageUse, examine, examine_and_try};
pub use setup::memory::Memory;
pub use setup::ranks::{ExchangeUse, RankUse, Ranks, ranks};
pub use setup::relaxation::Relaxation;
pub use sph_contribution::PluginInForce;
pub use sph_viscosity::Solves;
pub use step::flow::Flow;
pub use step::outlets::Left;
pub use step::snapshot::Snapshot;
