//! Shapes in the plane and in space, and how they move.

pub(crate) mod course;
pub(crate) mod outlines;
pub(crate) mod periodic_place;
pub(crate) mod polygon;
pub(crate) mod region;
pub(crate) mod shapes;
pub(crate) mod solid;
pub(crate) mod surround;
pub(crate) mod vector;
pub(crate) mod wall_geometry;
pub(crate) mod zone_shape;
