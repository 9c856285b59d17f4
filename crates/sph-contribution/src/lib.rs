//! What a piece of physics may offer a flow, and kinds of plugins for it that no crate of this project knows.
//!
//! * [`Contribution`]: columns with their values at the start, stages, pair terms, transported scalars, step
//!   limits, and work after kicks and drifts. The solver asks all of them for all of it and knows none by name.
//! * [`OwnColumn`]: a column that carries history. The store sorts, saves, keeps and rolls it back by its role.
//! * [`contribution_kind!`] declares a kind: scenes may name its plugins, `sph plugins` and the schema list them.
//!
//! What a contribution remembers from step to step belongs into its columns, not into its own fields: only
//! columns are rolled back when a step fails, and only they are in checkpoints.
#![doc = include_str!("../README.md")]

mod column;
mod contribution;
mod kinds;

pub use column::{Birth, Initial, OwnColumn};
pub use contribution::{Contribution, Setting, Stages};
pub use kinds::{OpenKind, open_kinds};

/// Crates that the macros name; use them through the macros only.
#[doc(hidden)]
pub mod reexport {
    pub use inventory;
    pub use sph_core;
    pub use toml;
}
