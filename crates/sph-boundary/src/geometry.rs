//! Walls as lines and triangles: meshed, joined, moved, and what is near or inside them.

pub(crate) mod cells;
pub(crate) mod checks;
pub(crate) mod cover;
pub(crate) mod drawing;
pub(crate) mod face_sums;
pub(crate) mod faces;
pub(crate) mod junctions;
pub(crate) mod lattice_layers;
pub(crate) mod layers;
pub(crate) mod lines;
pub(crate) mod mesh;
pub(crate) mod periodic;
pub(crate) mod planar;
pub(crate) mod plate;
pub(crate) mod polyline;
pub(crate) mod sets;
pub(crate) mod shells;
pub(crate) mod spatial_walls;
pub(crate) mod surface;
pub(crate) mod touching;
pub(crate) mod vector;
pub(crate) mod wall_end;
pub(crate) mod wall_mesh;
pub(crate) mod walls;
pub(crate) mod wedges;
