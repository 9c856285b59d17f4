//! What happens in a step: evaluation, kicks, drifts, and going back.

pub mod accounts;
pub(crate) mod births;
pub(crate) mod books;
pub(crate) mod clocks;
pub(crate) mod cost;
pub(crate) mod declared;
pub(crate) mod drift;
pub(crate) mod flow;
pub(crate) mod going_back;
pub mod guard;
pub(crate) mod guests;
pub(crate) mod hooks;
pub(crate) mod kept_image;
pub(crate) mod kept_rates;
pub(crate) mod kick;
pub(crate) mod leaving;
pub(crate) mod nursery;
pub(crate) mod observer;
pub(crate) mod outlets;
pub(crate) mod ranked;
pub(crate) mod snapshot;
pub(crate) mod sorting;
pub(crate) mod stages;
pub(crate) mod swing;
pub(crate) mod system;

pub use clocks::LISTS_NAME;
pub use cost::costs;
pub use drift::WALL_MOTION;
pub use flow::Flow;
pub use hooks::Hooked;
pub use nursery::Nursery;
pub use outlets::{Left, Outlets};
pub use snapshot::Snapshot;
pub use stages::{SharedWall, lock};
pub use swing::{Given, Swing};
