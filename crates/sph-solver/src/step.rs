//! A step: evaluation, kicks, drifts, and roll-back.

pub mod accounts;
pub(crate) mod drift;
pub(crate) mod energy_budget;
pub(crate) mod flow;
pub mod guard;
pub(crate) mod hooks;
pub(crate) mod kick;
pub(crate) mod leaving;
pub(crate) mod outlets;
pub(crate) mod ranked;
pub(crate) mod stages;
pub(crate) mod system;
pub mod term_accelerations;
pub(crate) mod variable_gravity;

pub use drift::WALL_MOTION;
pub use flow::{Flow, LISTS_NAME, NewParticleDefaults, Snapshot};
pub use hooks::Hooked;
pub use outlets::{OutletTotals, Outlets};
pub use ranked::costs;
pub use stages::Work;
pub use variable_gravity::{AddedGravity, VariableGravity};
