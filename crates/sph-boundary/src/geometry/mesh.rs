//! Walls cut into simplices: segments in the plane, triangles in space.
//!
//! * `elements`: nodes and elements;
//! * `motion`: walls that move as rigid bodies;
//! * `closest`, `tree`, `near`: elements near a place;
//! * `inside`: on which side of the walls a place is.
//!
//! The meshes come from polylines (`lines`) and from surfaces (`surface`).

mod closest;
mod elements;
mod inside;
mod motion;
mod near;
mod tree;

pub(crate) use closest::angle;
pub use closest::{Closest, SeenElement};
pub(crate) use elements::Simplices;
pub use elements::{Element, Face, FaceEdge, FreeEdge, Mesh, Node, Opening};
pub(crate) use inside::{SAME_DISTANCE, SAME_HEIGHT};
pub(crate) use motion::bed_of;
pub use sph_core::Feature;
pub(crate) use tree::Sides;
pub use tree::{ElementTree, NearElement, NearRows};

/// Points closer than this part of the spacing are the same place, and so much may a point lie off
/// an edge or a plane and still be on it.
pub(crate) const SAME_PLACE: f64 = 1e-6;
