//! A step: evaluation, kicks, drifts, and roll-back.

pub mod accounts;
pub(crate) mod clocks;
pub(crate) mod drift;
pub(crate) mod energy_budget;
pub(crate) mod flow;
pub mod guard;
pub(crate) mod hooks;
pub(crate) mod insertion;
pub(crate) mod kept_rates;
pub(crate) mod kick;
pub(crate) mod leaving;
pub(crate) mod new_particles;
pub(crate) mod outlets;
pub(crate) mod ranked;
pub(crate) mod restore;
pub(crate) mod snapshot;
pub(crate) mod stages;
pub(crate) mod system;
pub mod term_accelerations;
pub(crate) mod variable_gravity;

pub use clocks::LISTS_NAME;
pub use drift::WALL_MOTION;
pub use flow::Flow;
pub use hooks::Hooked;
pub use new_particles::NewParticleDefaults;
pub use outlets::{OutletTotals, Outlets};
pub use ranked::costs;
pub use snapshot::Snapshot;
pub use stages::Work;
pub use variable_gravity::{AddedGravity, VariableGravity};
