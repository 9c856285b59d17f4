//! Offers of a piece of physics to a flow, and kinds of plugins for it from outside this project.
//!
//! * [`Contribution`]: columns with their values at the start, and an [`Offer`]: stages, pair terms, transported scalars,
//!   step limits, hooks and gates. The solver calls every contribution once and names none.
//! * [`StepHook`]: work on velocities, positions and columns in some [`StepPhase`]s of a step, [`step_hook`] one from a
//!   function; a [`Kick`] advances the velocities itself.
//! * [`Gate`]: particles that leave, and [`Newborn`] particles.
//! * [`OwnColumn`]: a column that carries history. The store sorts, saves, keeps and rolls it back by its role.
//! * [`Limiter`]: a bound on the step, [`bound`] one from a function; [`sound_limit`] and [`force_limit`] are in every
//!   scene, [`motion_limit`] where walls move.
//! * [`contribution_kind!`] declares a kind: scenes may name its plugins, `sph plugins` and the schema list them.
//! * [`contributes!`] declares the contribution of a kind whose plugins are something else; [`Plugins`] has the plugins of all
//!   kinds for it. [`parts`] are the contributions of a scene.
//! * [`integrators`] advance a flow by kicks, drifts and evaluations.
//!
//! State of a contribution from step to step belongs into its columns, not into its own fields: columns alone are rolled
//! back when a step fails, and they alone are in checkpoints.
#![doc = include_str!("../README.md")]

mod contribution;
mod gate;
pub mod integrators;
mod kinds;
mod limits;
mod offer;
mod plugins;
mod step_hook;

pub use contribution::{Birth, Contribution, OwnColumn, Refusal, Setting};
pub use gate::{Gate, Newborn, even_out};
pub use kinds::{Contributor, FromPlugins, Part, contributes, parts};
pub use limits::{
    Limiter, bound, force_limit, largest, light_body_limit, motion_limit, sound_limit,
};
pub use offer::{Offer, ParticleEnergy, StoredEnergy};
pub use plugins::{PluginInForce, Plugins};
pub use step_hook::{
    Forces, Kick, OutsideForce, Report, StepHook, StepMoment, StepPhase, step_hook,
};

/// Stages of an evaluation.
pub type Stages<const D: usize> = Vec<Box<dyn sph_core::Stage<sph_neighbours::World<D>>>>;

/// Crates that the macros name; use them through the macros only.
#[doc(hidden)]
pub mod reexport {
    pub use inventory;
    pub use sph_core;
    pub use toml;
}
