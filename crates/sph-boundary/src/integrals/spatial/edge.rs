//! One directed edge of a facet as the point sees it, and the sum of many angles.

use std::f64::consts::TAU;

use super::knot::End;
use crate::geometry::vector::{Point, along, cross, dot};

/// Below this distance over h the logarithmic terms, of order A² ln A, are left out.
const NO_LOGARITHM: f64 = 1e-30;

/// An edge in the frame of its line, everything over h.
#[derive(Clone, Copy)]
pub(super) struct Edge {
    pub from: End,
    pub to: End,
    /// D: signed distance of the foot from the line, > 0 on the facet's side.
    pub offset: f64,
    /// Unit vector in the plane across the line, into the facet.
    pub inward: Point,
    /// A²: squared distance of the point from the line.
    pub a2: f64,
    /// a of the point over the plane, as this edge and the normal have it.
    pub height: f64,
    /// Squared distance of the point from the edge.
    pub distance2: f64,
}

/// The part of an edge in the sphere of a knot.
pub(super) enum Clip {
    Inside,
    Outside,
    /// From the first to the second end, which may be those of the edge.
    Between(End, End),
}

impl Edge {
    /// Corners relative to the point, their squared distances, the edge's squared length.
    ///
    /// The perpendicular from the point to the line is the same bit for bit when the edge is turned round. The angle
    /// between the two facets at the edge, as the point sees it, then comes out exactly however close the point is.
    #[inline]
    pub fn seen(corners: [Point; 2], r2: [f64; 2], whole: Point, l2: f64, n: Point) -> Self {
        let [r1, r2_] = corners;
        let per_l = 1.0 / l2.sqrt();
        let t = whole.map(|x| x * per_l);
        let y = [dot(r1, t), dot(r2_, t)];
        let first = r2[0] < r2[1] || (r2[0] == r2[1] && r1 < r2_);
        let perpendicular = if first {
            along(r1, -y[0], t)
        } else {
            along(r2_, -y[1], t)
        };
        let inward = cross(n, t);
        let a2 = dot(perpendicular, perpendicular);
        let (nearest, distance2) = if y[0] >= 0.0 {
            (r1, r2[0])
        } else if y[1] <= 0.0 {
            (r2_, r2[1])
        } else {
            (perpendicular, a2)
        };
        let end = |k: usize| End {
            y: y[k],
            q: r2[k].sqrt(),
        };
        Self {
            from: end(0),
            to: end(1),
            offset: -dot(perpendicular, inward),
            inward,
            a2,
            height: -dot(nearest, n),
            distance2,
        }
    }

    #[inline]
    pub fn clip(&self, radius: f64, radius_squared: f64) -> Clip {
        let beyond = [self.from.q >= radius, self.to.q >= radius];
        if !(beyond[0] || beyond[1]) {
            return Clip::Inside;
        }
        let reach2 = radius_squared - self.a2;
        if reach2 <= 0.0 || (beyond[0] && self.from.y >= 0.0) || (beyond[1] && self.to.y <= 0.0) {
            return Clip::Outside;
        }
        let reach = reach2.sqrt();
        let end = |y| End { y, q: radius };
        let from = if beyond[0] { end(-reach) } else { self.from };
        let to = if beyond[1] { end(reach) } else { self.to };
        Clip::Between(from, to)
    }

    #[inline]
    pub fn angle(&self) -> f64 {
        let (y1, y2) = (self.from.y, self.to.y);
        let cos = self.offset * self.offset + y1 * y2;
        (self.offset * (y2 - y1)).atan2(cos)
    }

    /// φ of the part that a clip has cut off.
    #[inline]
    pub fn angle_outside(&self, from: End, to: End) -> f64 {
        let d = self.offset;
        let mut sum = Winding::NONE;
        for (y1, y2) in [(self.from.y, from.y), (to.y, self.to.y)] {
            if y2 > y1 {
                sum.add(d * d + y1 * y2, d * (y2 - y1));
            }
        }
        sum.angle()
    }

    #[inline]
    pub fn solid_angle(&self, from: End, to: End) -> f64 {
        let (d, depth) = (self.offset, self.height.abs());
        let d2 = d * d;
        let sides = |end: End| {
            let y2 = end.y * end.y;
            let sin = d * end.y * (d2 + y2);
            let cos = (d2 * end.q + depth * y2) * (end.q + depth);
            [cos, sin]
        };
        let ([c1, s1], [c2, s2]) = (sides(from), sides(to));
        (s2 * c1 - s1 * c2).atan2(c1 * c2 + s1 * s2)
    }

    /// asinh(y/A) between two ends, with one logarithm and without cancellation.
    #[inline]
    pub fn logarithm(&self, from: End, to: End) -> f64 {
        let (far_from, far_to) = (from.y.abs() + from.q, to.y.abs() + to.q);
        if from.y >= 0.0 {
            (far_to / far_from).ln()
        } else if to.y <= 0.0 {
            (far_from / far_to).ln()
        } else if self.a2 < NO_LOGARITHM * NO_LOGARITHM {
            0.0
        } else {
            (far_to * far_from / self.a2).ln()
        }
    }
}

/// Σ φ over rotations given by any positive multiples of cos φ and sin φ, |φ| ≤ π.
#[derive(Clone, Copy)]
pub(super) struct Winding {
    cos: f64,
    sin: f64,
    turns: f64,
}

/// Lengths between the reciprocal of this and this are not normalised.
const LONG: f64 = 1e60;

impl Winding {
    pub const NONE: Self = Self {
        cos: 1.0,
        sin: 0.0,
        turns: 0.0,
    };

    /// Adds atan2(`sin`, `cos`).
    #[inline]
    pub fn add(&mut self, cos: f64, sin: f64) {
        let size = cos.abs() + sin.abs();
        if size == 0.0 {
            return;
        }
        let c = self.cos * cos - self.sin * sin;
        let s = self.cos * sin + self.sin * cos;
        // Crossing of the half line φ = π, which belongs to the upper half plane.
        if self.sin >= 0.0 && sin >= 0.0 && s < 0.0 {
            self.turns += 1.0;
        } else if self.sin < 0.0 && sin < 0.0 && s >= 0.0 {
            self.turns -= 1.0;
        }
        let length = c.abs() + s.abs();
        let scale = if (1.0 / LONG..=LONG).contains(&length) {
            1.0
        } else {
            1.0 / length
        };
        (self.cos, self.sin) = (c * scale, s * scale);
    }

    #[inline]
    pub fn angle(&self) -> f64 {
        // −0 is in the upper half plane too.
        (self.sin + 0.0).atan2(self.cos) + TAU * self.turns
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn angles_add_up_over_several_turns() {
        let counts = [40, 40, 7, 7, 5, 99];
        for (step, count) in [0.7, -0.7, 3.0, -3.0, 0.01, -0.1].into_iter().zip(counts) {
            let mut sum = Winding::NONE;
            for i in 0..count {
                let size = if i % 2 == 0 { 1e-25 } else { 1e33 };
                sum.add(size * f64::cos(step), size * f64::sin(step));
            }
            let off = (sum.angle() - step * f64::from(count)).abs();
            assert!(off < 1e-13, "{step}: {off:e}");
        }
    }

    #[test]
    fn right_angles_make_a_turn() {
        for sign in [1.0, -1.0] {
            let mut sum = Winding::NONE;
            for _ in 0..4 {
                sum.add(0.0, sign);
            }
            assert_eq!(sum.angle(), sign * TAU);
        }
        assert_eq!(Winding::NONE.angle(), 0.0);
    }
}
