//! Walls in space: surfaces as drawn, and the mesh of triangles made from them.
//!
//! * `places`, `drawn`, `crossing`: what is given is welded and checked;
//! * `patches`, `removal`, `seen`: planar pieces, without the places where walls touch face to face and without those
//!   that bound no fluid;
//! * `edges`, `lattice`, `fill`: the pieces cut into triangles of about the spacing, alike on
//!   both sides of every edge;
//! * `solid_angle`, `openings`: what a node stands for, and where the walls end;
//! * `triangle_mesh`: what comes out of it;
//! * `motion`, `inside`, `sides`, `closest`, `signed`, `grid`, `near`, `rows`: what a flow asks of the mesh.

mod build;
mod closest;
mod crossing;
mod drawn;
mod edges;
mod fill;
mod grid;
mod inside;
mod lattice;
mod motion;
mod near;
mod openings;
mod patches;
mod places;
mod removal;
mod rows;
mod seen;
mod sides;
mod signed;
mod solid_angle;
mod triangle_mesh;
mod vector;

pub use closest::{Closest, Feature};
pub use drawn::Surface;
pub use grid::{NearTriangle, TriangleGrid};
pub use signed::SeenTriangle;
pub use triangle_mesh::{Face, FaceEdge, FreeEdge, Node, Opening, Triangle, TriangleMesh};
