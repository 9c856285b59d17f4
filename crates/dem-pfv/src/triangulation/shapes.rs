//! Spheres and walls.

use crate::Vector;

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
