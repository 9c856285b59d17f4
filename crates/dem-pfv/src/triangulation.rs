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

use crate::Vector;

mod build;
mod cells;
mod expansion;
mod order;
mod predicates;

pub use crate::error::TriangulationError;
pub use cells::{Cell, Facet, Triangulation, Vertex};
pub(crate) use predicates::except;

/// A sphere: the weighted point (x, R²).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sphere {
    /// Centre x, m.
    pub centre: Vector,
    /// Radius R, m.
    pub radius: f64,
}

impl Sphere {
    /// A sphere with this centre and radius, m.
    pub fn new(centre: [f64; 3], radius: f64) -> Self {
        Self {
            centre: centre.into(),
            radius,
        }
    }

    /// Power of a point z: |z − x|² − R², m². Negative inside the sphere.
    pub fn power(&self, z: Vector) -> f64 {
        (z - self.centre).norm_squared() - self.radius * self.radius
    }
}

/// A planar wall: the points with n · x = c; the room is where n · x > c.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Wall {
    /// Unit normal n, into the room.
    pub normal: Vector,
    /// Offset c = n · x of the wall's points, m.
    pub offset: f64,
}

impl Wall {
    /// The wall through a point with an inward normal, which need not be of length 1.
    pub fn through(point: [f64; 3], normal: [f64; 3]) -> Self {
        let normal = Vector::from(normal).normalize();
        Self {
            normal,
            offset: normal.dot(&Vector::from(point)),
        }
    }

    /// The six walls of a box along the axes, in the order x₋, x₊, y₋, y₊, z₋, z₊.
    pub fn cuboid(low: [f64; 3], high: [f64; 3]) -> [Self; 6] {
        std::array::from_fn(|w| {
            let (axis, upper) = (w / 2, w % 2 == 1);
            let mut normal = Vector::zeros();
            normal[axis] = if upper { -1.0 } else { 1.0 };
            let offset = if upper { -high[axis] } else { low[axis] };
            Self { normal, offset }
        })
    }

    /// Signed distance n · x − c of a point, m; positive in the room.
    pub fn distance(&self, x: Vector) -> f64 {
        self.normal.dot(&x) - self.offset
    }

    /// Foot of the perpendicular from a point, m.
    pub fn projection(&self, x: Vector) -> Vector {
        x - self.distance(x) * self.normal
    }
}
