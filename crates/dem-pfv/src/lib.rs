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

mod error;

pub(crate) use error::{AT_LEAST_0, BELOW_1, POSITIVE};
pub use error::{OutOfRange, require};
pub use sph_core::Axis;

/// A vector in space, SI units of its quantity.
pub type Vector = nalgebra::Vector3<f64>;

/// Volume of a sphere (m³) by its radius (m).
pub(crate) fn sphere(radius: f64) -> f64 {
    4.0 / 3.0 * std::f64::consts::PI * radius.powi(3)
}
