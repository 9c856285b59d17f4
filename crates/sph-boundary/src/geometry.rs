//! Walls as lines and triangles: meshed, joined, moved, and queries for places near or inside them.

pub(crate) mod cells;
pub(crate) mod checks;
pub(crate) mod junctions;
pub(crate) mod lines;
pub(crate) mod mesh;
pub(crate) mod periodic;
pub(crate) mod plate;
pub(crate) mod polyline;
pub(crate) mod shells;
pub(crate) mod surface;
pub(crate) mod vector;
#[cfg(feature = "plugins")]
pub(crate) mod walls;
