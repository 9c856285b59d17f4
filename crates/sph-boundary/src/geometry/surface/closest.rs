//! The place of a triangle nearest to a point.

use super::grid::NearTriangle;
use super::triangle_mesh::TriangleMesh;
use super::vector::{Point, along, dot, norm, sub};

/// Which part of a triangle is nearest.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Feature {
    /// A place within.
    Face,
    /// A place on the edge from this corner to the next.
    Edge(u8),
    /// This corner.
    Corner(u8),
}

/// The place of a triangle nearest to a point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Closest {
    /// From the point to it, m.
    pub offset: [f64; 3],
    /// What it is of the triangle.
    pub feature: Feature,
    /// Height of the point above the triangle's plane, positive on the fluid's side, m.
    pub height: f64,
}

impl Closest {
    /// Distance from the point, m.
    pub fn distance(&self) -> f64 {
        norm(self.offset)
    }
}

impl TriangleMesh {
    /// The place of an image of a triangle nearest to a point.
    ///
    /// The regions of a triangle as in Ericson, Real-Time Collision Detection (2005), §5.1.5.
    pub fn closest(&self, point: [f64; 3], near: NearTriangle) -> Closest {
        let corners = self.corners_from(point, near);
        let normal = self.triangles[near.triangle as usize].normal;
        let (offset, feature) = nearest_to_origin(corners);
        Closest {
            offset,
            feature,
            height: -dot(corners[0], normal),
        }
    }
}

/// The place of a triangle nearest to the origin.
pub(super) fn nearest_to_origin([a, b, c]: [Point; 3]) -> (Point, Feature) {
    let (ab, ac) = (sub(b, a), sub(c, a));
    let (d1, d2) = (-dot(ab, a), -dot(ac, a));
    if d1 <= 0.0 && d2 <= 0.0 {
        return (a, Feature::Corner(0));
    }
    let (d3, d4) = (-dot(ab, b), -dot(ac, b));
    if d3 >= 0.0 && d4 <= d3 {
        return (b, Feature::Corner(1));
    }
    let vc = d1 * d4 - d3 * d2;
    if vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0 {
        return (along(a, d1 / (d1 - d3), ab), Feature::Edge(0));
    }
    let (d5, d6) = (-dot(ab, c), -dot(ac, c));
    if d6 >= 0.0 && d5 <= d6 {
        return (c, Feature::Corner(2));
    }
    let vb = d5 * d2 - d1 * d6;
    if vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0 {
        return (along(a, d2 / (d2 - d6), ac), Feature::Edge(2));
    }
    let va = d3 * d6 - d5 * d4;
    if va <= 0.0 && d4 >= d3 && d5 >= d6 {
        let part = (d4 - d3) / ((d4 - d3) + (d5 - d6));
        return (along(b, part, sub(c, b)), Feature::Edge(1));
    }
    let sum = va + vb + vc;
    let within = along(along(a, vb / sum, ab), vc / sum, ac);
    (within, Feature::Face)
}
