//! The integrals of one segment seen from one point.

use super::primitives::End;
use super::renormalisation::Renormalisation2d;

/// Below this distance over h the logarithmic terms, of order a² ln a, are no longer counted.
const NO_LOGARITHM: f64 = 1e-30;

/// Where a segment contains the point that looks at it.
///
/// A segment that contains the point has Γ_as = 0; the point's θ accounts for it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Contact {
    /// The point is not on the segment.
    None,
    /// The point is the segment's first vertex.
    Start,
    /// The point is the segment's second vertex.
    End,
    /// The point is on the segment between its vertices.
    Inside,
}

/// What one segment adds to γ and ∇γ of one point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SegmentIntegral {
    /// ∫_s w dS: ∇Γ_as is this times the inward normal, 1/m.
    pub kernel: f64,
    /// Γ_as, to be subtracted from θ; positive for a point on the fluid's side.
    pub gamma: f64,
    /// Whether the point is on the segment.
    pub contact: Contact,
}

impl SegmentIntegral {
    /// A segment out of reach.
    pub const NOTHING: Self = Self {
        kernel: 0.0,
        gamma: 0.0,
        contact: Contact::None,
    };
}

impl Renormalisation2d {
    /// Integrals over the segment from `start` to `end`, both relative to the point, m.
    ///
    /// `normal` is the inward unit normal, on the left of start → end. Segments that share a vertex
    /// must be given bitwise the same vector to it: then the angles under which they are seen add
    /// up to rounding however close the point is to that vertex.
    #[inline]
    pub fn segment(&self, start: [f64; 2], end: [f64; 2], normal: [f64; 2]) -> SegmentIntegral {
        let (x1, y1) = (start[0] * self.per_h, start[1] * self.per_h);
        let (x2, y2) = (end[0] * self.per_h, end[1] * self.per_h);
        let (r1, r2) = (x1 * x1 + y1 * y1, x2 * x2 + y2 * y2);
        // The nearer end gives the distance to the line with an error relative to its own distance.
        let (x, y) = if r1 < r2 { (x1, y1) } else { (x2, y2) };
        let a = -(x * normal[0] + y * normal[1]);
        let t1 = x1 * normal[1] - y1 * normal[0];
        let t2 = x2 * normal[1] - y2 * normal[0];
        self.on_line(a, [t1, t2], [r1, r2])
    }

    /// The same in the frame of the line, everything over h: signed distance a, abscissae of both
    /// ends, their squared distances.
    fn on_line(&self, a: f64, t: [f64; 2], r: [f64; 2]) -> SegmentIntegral {
        let contact = contact(a, t, r);
        let (a2, depth) = (a * a, a.abs());
        let full = [
            End {
                y: t[0],
                q: r[0].sqrt(),
            },
            End {
                y: t[1],
                q: r[1].sqrt(),
            },
        ];
        // Angle and logarithm of the whole segment serve every knot that does not clip it.
        let mut whole: Option<(f64, f64)> = None;
        let (mut kernel, mut gamma, mut smooth) = (0.0, 0.0, 0.0);
        for knot in &self.knots {
            let rho = knot.radius;
            if depth >= rho {
                break;
            }
            let [mut from, mut to] = full;
            let clipped = [from.q >= rho, to.q >= rho];
            if clipped[0] || clipped[1] {
                let reach = ((rho - a) * (rho + a)).sqrt();
                if clipped[0] {
                    if from.y > 0.0 {
                        break;
                    }
                    from = End { y: -reach, q: rho };
                }
                if clipped[1] {
                    if to.y < 0.0 {
                        break;
                    }
                    to = End { y: reach, q: rho };
                }
            }
            let (angle, log) = match whole {
                Some(known) if !(clipped[0] || clipped[1]) => known,
                _ => (angle(a, from, to), logarithm(depth, from, to)),
            };
            if !(clipped[0] || clipped[1]) {
                whole = Some((angle, log));
            }
            let p = knot.between(a2, from, to);
            kernel += p.gradient + p.gradient_log * log;
            smooth += p.gamma + p.gamma_log * log;
            gamma += knot.angle * angle;
        }
        for ring in &self.rings {
            if depth < ring.outer && t[0] < ring.outer && t[1] > -ring.outer {
                let [f, k] = ring.integrals(a, t[0], t[1]);
                kernel += f;
                gamma += a * k;
            }
        }
        let gamma = if contact == Contact::None {
            gamma - a * smooth
        } else {
            0.0
        };
        SegmentIntegral {
            kernel: kernel * self.per_h,
            gamma,
            contact,
        }
    }
}

/// Signed angle under which the piece is seen, positive from the fluid's side.
#[inline]
fn angle(a: f64, from: End, to: End) -> f64 {
    (a * (to.y - from.y)).atan2(from.y * to.y + a * a)
}

/// asinh(y₂/a) − asinh(y₁/a) with one logarithm and without cancellation.
#[inline]
fn logarithm(depth: f64, from: End, to: End) -> f64 {
    if depth < NO_LOGARITHM {
        return 0.0;
    }
    let (far_from, far_to) = (from.y.abs() + from.q, to.y.abs() + to.q);
    if from.y >= 0.0 {
        (far_to / far_from).ln()
    } else if to.y <= 0.0 {
        (far_from / far_to).ln()
    } else {
        ((far_to / depth) * (far_from / depth)).ln()
    }
}

#[inline]
fn contact(a: f64, t: [f64; 2], r: [f64; 2]) -> Contact {
    if r[0] == 0.0 {
        Contact::Start
    } else if r[1] == 0.0 {
        Contact::End
    } else if a == 0.0 && t[0] < 0.0 && t[1] > 0.0 {
        Contact::Inside
    } else {
        Contact::None
    }
}
