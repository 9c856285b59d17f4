//! Open faces: fluid comes in and goes out through semi-analytical walls, `[wall.NAME.open-boundary.PLUGIN]`.
//!
//! * [`OpenBoundary`] is the law of a face: from the fluid in front of it ([`FluidMean`]) to what passes and which pressure
//!   acts ([`FaceValues`]). Built in: [`VelocityInlet`], [`FlowRate`], [`Pressure`], [`Level`], [`Outflow`].
//! * [`open`] puts the faces around the wall treatment of a scene, and gives the [`OpenBoundaries`] that let mass through.
//! * [`waves`] makes waves by paddles and open faces, and measures reflected waves by gauges.
// Unit tests name no plugin. Without registration they compile what they call, not all loops of the crate again.
#![cfg_attr(
    test,
    allow(unused_imports, reason = "plugins are not registered in unit tests")
)]
#![doc = include_str!("../README.md")]

mod air;
mod budget;
mod cells;
mod contract;
mod contribution;
mod evenness;
mod exits;
mod face_values;
mod faces;
mod flux;
mod laws;
mod memory;
mod profile;
mod row;
mod walls;
pub mod waves;

pub(crate) use contract::refuse;
pub use contract::{
    Entering, FaceElement, FaceValues, FluidMean, Moment, OpenBoundary, OpenBoundaryEntry,
    OpenRefusal, OpenSetting,
};
pub use contribution::{OpenBoundaries, open};
pub use flux::OPEN_FLUX;
pub use laws::{FlowRate, Level, Outflow, Pressure, VelocityInlet};
pub use profile::Profile;
