//! Distance and side of a place from a few triangles.

use super::closest::nearest_to_origin;
use super::grid::NearTriangle;
use super::triangle_mesh::TriangleMesh;
use super::vector::{Point, dot, norm, sub};

/// An image of a triangle relative to a point.
#[derive(Clone, Copy, Debug)]
pub struct SeenTriangle {
    corners: [Point; 3],
    normal: Point,
    /// Centre and radius of a sphere around it, m.
    sphere: (Point, f64),
}

impl TriangleMesh {
    /// An image of a triangle as seen from a point.
    pub fn seen(&self, point: [f64; 3], near: NearTriangle) -> SeenTriangle {
        let corners = self.corners_from(point, near);
        let sum = |k: usize| corners[0][k] + corners[1][k] + corners[2][k];
        let centre = [0, 1, 2].map(|k| sum(k) / 3.0);
        let arms = corners.map(|corner| norm(sub(corner, centre)));
        let radius = arms.into_iter().fold(0.0, f64::max) * (1.0 + 1e-9);
        SeenTriangle {
            corners,
            normal: self.triangles[near.triangle as usize].normal,
            sphere: (centre, radius),
        }
    }
}

impl SeenTriangle {
    /// Distance of the nearest of some triangles from a place, m, positive on its fluid's side;
    /// `None` if none of them is nearer than `within`. The place is relative to the point that they
    /// are seen from.
    pub fn signed_distance(seen: &[Self], place: [f64; 3], within: f64) -> Option<f64> {
        let (mut distance, mut height) = (f64::INFINITY, 0.0_f64);
        for triangle in seen {
            let (centre, radius) = triangle.sphere;
            let apart = sub(centre, place);
            // What may be equally near is looked at.
            let limit = distance.min(within) * (1.0 + 1e-6) + radius;
            if dot(apart, apart) > limit * limit {
                continue;
            }
            let corners = triangle.corners.map(|corner| sub(corner, place));
            let new = norm(nearest_to_origin(corners).0);
            if new >= within {
                continue;
            }
            let over = -dot(corners[0], triangle.normal);
            // Triangles at an edge are equally near; the one seen more from above decides, and of
            // two that face each other the one seen from its front.
            let decides = match (new - distance).abs() <= 1e-9 * new {
                true => {
                    let (new, old) = (over.abs(), height.abs());
                    new > old * (1.0 + 1e-9) || (new >= old * (1.0 - 1e-9) && over > 0.0)
                }
                false => new < distance,
            };
            if decides {
                (distance, height) = (new, over);
            }
        }
        let sign = if height >= 0.0 { 1.0 } else { -1.0 };
        distance.is_finite().then_some(sign * distance)
    }
}
