//! Grains and the flow through their pores: discrete elements and a pore-scale finite-volume flow (Catalano 2012).
//!
//! * [`grains`]: spheres that touch each other, walls and meshes, moved by their contact forces.
//! * [`triangulation`]: regular triangulation of spheres between walls.
//! * [`flow`]: creeping flow through the pores, and its forces on the grains.
//! * [`coupled`]: grains and flow together, coupled both ways.
//! * `scene`, with the feature of that name: scenes that are read, run, measured and written.
//!
//! Contact laws and conductances are plugins of `sph-core`: [`ContactLawEntry`](grains::ContactLawEntry),
//! [`ConductanceEntry`](flow::ConductanceEntry).

pub mod coupled;
pub mod flow;
pub mod grains;
#[cfg(feature = "scene")]
pub mod scene;
pub mod triangulation;

mod axis;
mod range;

pub use axis::Axis;
pub use range::{OutOfRange, require};
