//! A plane with coordinates in it.

use crate::geometry::vector::{Point, along, cross, dot, sub, unit};

#[derive(Clone, Copy, Debug)]
pub(crate) struct Plane {
    origin: Point,
    axes: [Point; 2],
}

impl Plane {
    /// The plane through a place, m, across a unit normal.
    pub fn new(origin: Point, normal: Point) -> Self {
        // The coordinate axis that is farthest from the normal.
        let mut axis = [0.0; 3];
        let flattest = (0..3).min_by(|i, j| normal[*i].abs().total_cmp(&normal[*j].abs()));
        axis[flattest.unwrap_or(0)] = 1.0;
        Self::along(along(axis, -dot(axis, normal), normal), origin, normal)
    }

    /// The same with the first axis along a direction in it.
    pub fn along(direction: Point, origin: Point, normal: Point) -> Self {
        let first = unit(direction);
        let axes = [first, cross(normal, first)];
        Self { origin, axes }
    }

    /// Coordinates of the foot of the perpendicular from a point, m.
    #[inline]
    pub fn foot(&self, point: Point) -> [f64; 2] {
        self.part(sub(point, self.origin))
    }

    /// The part of a vector in the plane, by its axes.
    #[inline]
    pub fn part(&self, vector: Point) -> [f64; 2] {
        [dot(vector, self.axes[0]), dot(vector, self.axes[1])]
    }

    /// The place with some coordinates, m.
    pub fn place(&self, x: [f64; 2]) -> Point {
        along(along(self.origin, x[0], self.axes[0]), x[1], self.axes[1])
    }
}
