//! Assembles the plugins a scene names into a plan, and runs it.
//!
//! The solver knows traits and the registry, never a concrete kernel, wall, rheology,
//! formulation, integrator, probe or solution: names come from the scene, or from
//! [`defaults`] where the scene is silent.
//!
//! * [`assemble()`]: scene → [`Flow`]: columns, stages in order, step limits.
//! * [`Flow`]: one evaluation, one step; a [`sph_core::System`] for the integrator.
//! * [`run()`]: steps, outputs, checkpoints, roll-back, references, summary.
//! * [`examine()`]: the numbers that follow from a scene, without running it.
//! * [`rheometer`]: a law by its name, sheared alone.

mod adviser;
mod assemble;
mod bad_pictures;
mod balance;
mod checkpoint;
mod choices;
mod clocks;
mod counters;
pub mod defaults;
mod dilatation;
mod domain;
mod drawn;
mod driver;
mod edges;
mod elastic;
mod error;
mod estimate;
mod examine;
mod field_error;
mod findings;
mod flow;
mod ground;
mod guard;
mod held_back;
mod identity;
mod implicit;
mod initial;
mod kept;
mod lattices;
mod layers;
mod limits;
mod lock;
mod mach;
mod measured;
mod memory;
mod options;
mod outlets;
mod output;
mod placed;
mod planning;
mod references;
mod relax;
mod remedies;
mod report;
mod retreat;
pub mod rheometer;
mod run;
mod seepage;
mod series;
mod snapshot;
mod sorting;
mod sound;
mod stages;
mod sub_steps;
mod summary;
mod trouble;
mod wall_speeds;
mod walls;

pub use assemble::{Assembled, assemble};
pub use driver::{Command, Observer, Progress};
pub use error::{Failure, SolverError};
pub use estimate::{Estimate, Size, size};
pub use examine::{Examination, FieldUse, StageUse, examine};
pub use findings::{Findings, Share, Sighting, Suspect};
pub use flow::Flow;
pub use identity::{FileMark, Identity, marks};
pub use implicit::Solves;
pub use memory::Memory;
pub use options::{RunOptions, Start};
pub use outlets::Left;
pub use relax::Relaxation;
pub use run::run;
pub use snapshot::Snapshot;
pub use summary::{Drift, ErrorEntry, PluginInForce, Status, Summary};
pub use trouble::Trouble;
