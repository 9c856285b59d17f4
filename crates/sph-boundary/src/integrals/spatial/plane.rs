//! Triangles in the coordinates of their plane.

use crate::geometry::plane::Plane;

/// A triangle in the coordinates of its plane, ready to be seen from many points.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Patch {
    /// Mean of the corners, m.
    pub centre: [f64; 2],
    /// The first two corners from there, m; the third makes their sum vanish.
    pub arms: [[f64; 2]; 2],
    /// Squared distances of the corners from there, m².
    pub squares: [f64; 3],
    /// m².
    pub area: f64,
}

/// The circle around a triangle in the coordinates of its plane, about the mean of the corners.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Circle {
    /// m.
    centre: [f64; 2],
    /// m.
    radius: f64,
}

impl Patch {
    /// A triangle with corners in or close to a plane, m, and its area, m²; and the circle around it.
    pub fn new(plane: &Plane, corners: [[f64; 3]; 3], area: f64) -> (Self, Circle) {
        let [a, b, c] = corners.map(|corner| plane.foot(corner));
        let centre = [0, 1].map(|k| (a[k] + b[k] + c[k]) / 3.0);
        let arms = [a, b, c].map(|corner| [corner[0] - centre[0], corner[1] - centre[1]]);
        let squares = arms.map(|arm| arm[0] * arm[0] + arm[1] * arm[1]);
        let patch = Self {
            centre,
            arms: [arms[0], arms[1]],
            squares,
            area,
        };
        // Rounding loses nothing.
        let radius = squares.into_iter().fold(0.0, f64::max).sqrt() * (1.0 + 1e-9);
        (patch, Circle { centre, radius })
    }
}

impl Circle {
    /// True if it meets the disc of the plane within the support.
    #[inline(always)]
    pub fn meets(&self, foot: &Foot) -> bool {
        let [x, y] = foot.to(self.centre);
        let reach = foot.reach + self.radius;
        x * x + y * y < reach * reach
    }
}

/// Foot of a point on a plane, and the part of the plane in its sight.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Foot {
    /// Coordinates of the foot of the perpendicular, m.
    pub place: [f64; 2],
    /// Signed distance from the plane, m.
    pub height: f64,
    /// Radius of the disc of the plane within the support, m.
    pub reach: f64,
}

impl Foot {
    /// A place as seen from the foot, m.
    #[inline(always)]
    pub fn to(&self, place: [f64; 2]) -> [f64; 2] {
        [place[0] - self.place[0], place[1] - self.place[1]]
    }
}
