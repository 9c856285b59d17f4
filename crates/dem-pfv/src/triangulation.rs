//! Regular triangulation of spheres in space, bounded by planar walls or by the hull of the centres.
//!
//! A sphere with centre x and radius R weighs R². The power of a point z is π(z) = |z − x|² − R²
//! (m²); the power diagram gives every sphere the points of least power, and the regular (weighted
//! Delaunay) triangulation is its dual. With equal radii it is the Delaunay triangulation. Between
//! unequal spheres that do not overlap deeply its cells' power centres lie in the void, which is why
//! pore-scale flow is built on it (Catalano 2012, §3.1).
//!
//! * [`Triangulation`]: [`Triangulation::of_spheres`] between nothing but the spheres,
//!   [`Triangulation::within`] between walls; its [`Cell`]s, [`Facet`]s, neighbours, power centres.
//! * [`Sphere`] and [`Wall`]: the input; [`Wall::cuboid`] makes the six walls of a box.
//! * [`TriangulationError`]: refusals, with the sphere or the wall by its number.
//!
//! A wall is one vertex at infinity, the limit of a tangent sphere of infinite radius; the power
//! bisector between a sphere and a wall is the wall itself, so power centres lie exactly on walls.
//! Decisions are exact for the numbers given, ties are broken by the spheres' numbers, and so the
//! result neither depends on the order of insertion nor fails on lattices.
//!
//! ```
//! use dem_pfv::triangulation::{Sphere, Triangulation, Wall};
//!
//! // Eight spheres at the corners of a cube: all on one sphere, the degenerate case.
//! let mut spheres = Vec::new();
//! for i in 0..8 {
//!     let at = |bit: usize| if i >> bit & 1 == 1 { 0.75 } else { 0.25 };
//!     spheres.push(Sphere::new([at(0), at(1), at(2)], 0.25));
//! }
//! let walls = Wall::cuboid([0.0; 3], [1.0; 3]);
//! let mesh = Triangulation::within(&spheres, &walls)?;
//! let inner = mesh.cells.iter().filter(|cell| cell.walls() == 0).count();
//! assert!(inner == 5 || inner == 6); // the two ways to cut a cube
//! # Ok::<(), dem_pfv::triangulation::TriangulationError>(())
//! ```

mod build;
mod cells;
mod expansion;
mod order;
mod predicates;
mod shapes;

pub use crate::error::TriangulationError;
pub(crate) use cells::without;
pub use cells::{Cell, Facet, Triangulation, Vertex};
pub use shapes::{Sphere, Wall};
