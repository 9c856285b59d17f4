//! Scenes of particles as a model that `sph-run` drives.
//!
//! * [`run()`]: steps, outputs, checkpoints, roll-back, references, summary.
//! * [`run_part()`]: the same on one of several ranks, with a part of the particles.
//! * [`Stepper`]: the same in memory, step by step, with columns that may be changed in between.
//! * [`setup`]: a scene becomes particles, walls and a flow, without a run.
//! * [`examine_and_try()`]: the numbers that follow from a scene, and a trial of its first steps.
//!
//! Plugins and steps come from `sph-solver`.

mod failure;
mod results;
mod running;
pub mod setup;
mod subject;
mod zones;

pub use failure::error::{Failure, RunError};
pub use failure::findings::{Findings, ParticleRecord, Share, Suspect};
pub use results::scene_picture::draw_scene;
pub use results::summary::{Drift, ErrorEntry, RankShare, Summary};
pub use running::run::{run, run_on_threads, run_part};
pub use running::trial::{Trial, examine_and_try};
pub use sph_multiphase::viscosity::Solves;
pub use subject::{Particles, identity};
pub use zones::{Stepper, ZoneSize};
