//! The place of an element nearest to a point; distance and side of a place from a few elements.

use sph_core::{Feature, nearest_place};

use super::elements::Mesh;
use super::tree::NearElement;
use crate::geometry::vector::{dot, norm, sub};

/// The place of an element nearest to a point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Closest<const D: usize> {
    /// From the point to it, m.
    pub offset: [f64; D],
    /// The part of the element.
    pub feature: Feature,
    /// Height of the point above the element's line or plane, positive on the fluid's side, m.
    pub height: f64,
}

impl<const D: usize> Closest<D> {
    /// Distance from the point, m.
    pub fn distance(&self) -> f64 {
        norm(self.offset)
    }
}

/// Two lengths that differ by less than this part are equal.
const ALIKE: f64 = 1e-9;

/// An image of an element relative to a point.
#[derive(Clone, Copy, Debug)]
pub struct SeenElement<const D: usize> {
    corners: [[f64; D]; D],
    normal: [f64; D],
    /// Centre and radius of a sphere around it, m.
    sphere: ([f64; D], f64),
}

impl<const D: usize> Mesh<D> {
    /// The place of an image of an element nearest to a point.
    pub fn closest(&self, point: [f64; D], near: NearElement<D>) -> Closest<D> {
        let corners = self.corners_from(point, near);
        let (offset, feature) = nearest_place([0.0; D], &corners);
        Closest {
            offset,
            feature,
            height: -dot(corners[0], self.elements[near.index()].normal),
        }
    }

    /// An image of an element as seen from a point.
    pub fn seen(&self, point: [f64; D], near: NearElement<D>) -> SeenElement<D> {
        let corners = self.corners_from(point, near);
        let sum = |k: usize| corners[1..].iter().fold(corners[0][k], |sum, c| sum + c[k]);
        let centre = std::array::from_fn(|k| sum(k) / D as f64);
        let arms = corners.map(|corner| norm(sub(corner, centre)));
        let radius = arms.into_iter().fold(0.0, f64::max) * (1.0 + ALIKE);
        SeenElement {
            corners,
            normal: self.elements[near.index()].normal,
            sphere: (centre, radius),
        }
    }
}

/// Angle of a triangle at a corner, rad.
pub(crate) fn angle<const D: usize>(corners: &[[f64; D]; D], k: usize) -> f64 {
    let [a, b] = [1, 2].map(|n| sub(corners[(k + n) % D], corners[k]));
    (dot(a, b) / (norm(a) * norm(b))).clamp(-1.0, 1.0).acos()
}

impl<const D: usize> SeenElement<D> {
    /// Distance of the nearest of some elements from a place, m, positive on its fluid's side; `None` if none of them
    /// is nearer than `within`. The place is relative to the point that they are seen from.
    pub fn signed_distance(seen: &[Self], place: [f64; D], within: f64) -> Option<f64> {
        let (mut distance, mut height) = (f64::INFINITY, 0.0_f64);
        for element in seen {
            let (centre, radius) = element.sphere;
            let apart = sub(centre, place);
            // Elements that may be equally near are examined.
            let limit = distance.min(within) * (1.0 + 1e-6) + radius;
            if dot(apart, apart) > limit * limit {
                continue;
            }
            let corners = element.corners.map(|corner| sub(corner, place));
            let new = norm(nearest_place([0.0; D], &corners).0);
            if new >= within {
                continue;
            }
            let over = -dot(corners[0], element.normal);
            let decides = match (new - distance).abs() <= ALIKE * new {
                true => is_front(over, height, D),
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

/// Elements at a corner or an edge are equally near; the one seen more from above decides, and of two that face each other
/// (a plate of zero thickness) the one seen from its front.
fn is_front(over: f64, height: f64, dimension: usize) -> bool {
    let (new, old) = (over.abs(), height.abs());
    let faces = (over + height).abs() <= ALIKE * old;
    match (dimension, faces) {
        (2, true) => over > 0.0,
        (2, false) => new > old,
        _ => new > old * (1.0 + ALIKE) || (new >= old * (1.0 - ALIKE) && over > 0.0),
    }
}
