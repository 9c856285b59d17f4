//! Distance and side of a place from a few segments.

use super::segment_mesh::{NearSegment, SegmentMesh};
use crate::geometry::segment_distance::distance_squared;

/// An image of a segment relative to a point.
#[derive(Clone, Copy, Debug)]
pub struct SeenSegment {
    ends: [[f64; 2]; 2],
    normal: [f64; 2],
}

impl SegmentMesh {
    /// An image of a segment as seen from a point.
    pub fn seen(&self, point: [f64; 2], near: NearSegment) -> SeenSegment {
        SeenSegment {
            ends: self.seen_from(point, near),
            normal: self.segments[near.segment].normal,
        }
    }
}

impl SeenSegment {
    /// Distance of the nearest of some segments from a place, m, positive on its fluid's side;
    /// `None` if none of them is nearer than `within`. The place is relative to the point that they
    /// are seen from.
    pub fn signed_distance(seen: &[Self], place: [f64; 2], within: f64) -> Option<f64> {
        let (mut nearest, mut height) = (f64::INFINITY, 0.0_f64);
        for segment in seen {
            let [start, end] = segment.ends.map(|[x, y]| [x - place[0], y - place[1]]);
            let distance2 = distance_squared(start, end);
            if distance2 >= within * within {
                continue;
            }
            let over = -(start[0] * segment.normal[0] + start[1] * segment.normal[1]);
            // Two segments at a corner are equally near; the one seen more from above decides.
            // Both faces of a plate of zero thickness are, too; the one seen from its front does.
            let same = (distance2 - nearest).abs() <= 1e-9 * distance2;
            let faces = (over + height).abs() <= 1e-9 * height.abs();
            let decides = match (same, faces) {
                (true, true) => over > 0.0,
                (true, false) => over.abs() > height.abs(),
                (false, _) => distance2 < nearest,
            };
            if decides {
                (nearest, height) = (distance2, over);
            }
        }
        let sign = if height >= 0.0 { 1.0 } else { -1.0 };
        nearest.is_finite().then(|| sign * nearest.sqrt())
    }
}
