//! From names in a scene to plugins, and from plugins to a plan.

pub(crate) mod assembly;
pub(crate) mod choices;
pub(crate) mod planning;

pub use choices::{Choices, own_accounts, plugins, shown};
pub use planning::{Planning, StagePlan};
