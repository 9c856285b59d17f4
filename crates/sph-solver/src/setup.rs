//! From names in a scene to plugins, and from plugins to a plan.

pub(crate) mod choices;
pub(crate) mod joining;
pub(crate) mod planning;
pub(crate) mod transported;

pub use choices::{Choices, own_accounts, plugins, shown};
pub use joining::{Given, joined};
pub use planning::{Planned, Planning, SharedTerms};
