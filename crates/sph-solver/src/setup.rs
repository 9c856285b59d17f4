//! From names in a scene to plugins, and from plugins to a plan.

pub(crate) mod builder;
pub(crate) mod choices;
pub(crate) mod in_force;
pub(crate) mod joining;
pub(crate) mod parts;
pub(crate) mod planning;
pub(crate) mod transported;

pub use builder::{Builder, Part};
pub use choices::{Choices, ImplicitSolve, Physics};
pub use in_force::PluginInForce;
pub use joining::{Given, joined};
pub use parts::{parts, strangers};
pub use planning::{Planned, Planning, SharedTerms};
