//! What a piece of physics may offer a flow, and kinds of plugins for it that no crate of this project knows.
//!
//! * [`Contribution`]: columns with their values at the start, stages, pair terms, transported scalars and step
//!   limits. The solver asks all of them for all of it and knows none by name.
//! * [`StepWork`]: what it does with velocities, positions and columns of its own between the evaluations, and [`Newborn`] particles.
//! * [`OwnColumn`]: a column that carries history. The store sorts, saves, keeps and rolls it back by its role.
//! * [`Limiter`]: a bound on the step; [`SoundLimit`] and [`ForceLimit`] are in every scene, [`MotionLimit`] where
//!   walls move.
//! * [`contribution_kind!`] declares a kind: scenes may name its plugins, `sph plugins` and the schema list them.
//!
//! What a contribution remembers from step to step belongs into its columns, not into its own fields: only
//! columns are rolled back when a step fails, and only they are in checkpoints.
#![doc = include_str!("../README.md")]

mod column;
mod contribution;
mod even_out;
mod kinds;
mod limiter;
mod limits;
mod newborn;
mod refusal;
mod step_work;

pub use column::{Birth, Initial, OwnColumn};
pub use contribution::{Contribution, Setting};
pub use even_out::even_out;
pub use kinds::{OpenKind, open_kinds};
pub use limiter::Limiter;
pub use limits::{ForceLimit, LightBodyLimit, MotionLimit, SoundLimit};
pub use newborn::Newborn;
pub use refusal::Refusal;
pub use step_work::{Forces, OutsideForce, StepWork, StoredEnergy};

/// Stages of an evaluation.
pub type Stages<const D: usize> = Vec<Box<dyn sph_core::Stage<sph_neighbours::World<D>>>>;

/// Crates that the macros name; use them through the macros only.
#[doc(hidden)]
pub mod reexport {
    pub use inventory;
    pub use sph_core;
    pub use toml;
}
