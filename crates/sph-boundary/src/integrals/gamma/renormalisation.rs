//! The integrals of a kernel over segments of the plane, alone and side by side.

use sph_kernels::PiecewisePolynomial;
use sph_kernels::lanes::{Body, Lane, MOST, atan2, dispatch, ln};

use super::primitives::{Knot, Ring, tables};
use crate::error::Result;
use crate::integrals::{End, normalisation};

/// Exact wall integrals of one kernel in two dimensions.
///
/// With the vector **r** from the point a to the wall, n the inward normal and w the kernel,
///
/// ```text
/// γ_a = ∫_Ω w dV = θ_a − Σ_s Γ_as,   Γ_as = ∫_s H̃(r) (r·n)/r dS,   ∇γ_a = Σ_s n_s ∫_s w dS
/// H̃(r) = (1/r) [∫₀^r w s ds − 1/(2π)] = −K(r)/(2πr),              K(r) = 2π ∫_r^∞ w s ds
/// ```
///
/// because ∇·(H̃ r/r) = w − δ. The kernel is written as a sum over its knots ρ_j of polynomials that
/// end there, f(q) = Σ Δ_j(q) over the ρ_j > q, Δ_j the difference of the pieces on either side, so each
/// segment is clipped once per knot circle. On the line at the distance a all lengths divided by h:
///
/// ```text
/// I_n = ∫ qⁿ dy = (y qⁿ + n a² I_{n−2})/(n + 1),   I_0 = y,   I_{−1} = asinh(y/a),   q² = a² + y²
/// h ∫ w dS = σ Σ c_n I_n,                 Γ_as = (1/2π) [C α − 2πσ a Σ c_n I_n/(n + 2)]
/// ```
///
/// with α the angle under which the clipped segment is seen and C = 2πσ ∫₀^ρ Δ q dq.
///
/// | symbol | meaning | unit |
/// |---|---|---|
/// | γ, Γ_as, θ | renormalisation factor, an element's part, fluid angle over 2π | 1 |
/// | ∇γ, ∫ w dS | gradient and an element's part, along n | 1/m |
/// | a, y, q | signed distance to the line (> 0 in the fluid), abscissa on it, distance; over h | 1 |
///
/// Valid for any piecewise polynomial and at every distance, touching included. The rounding of the closed form is
/// amplified by the cancellation σ Σ|c_n| ρⁿ⁺¹/(n + 1) of the kernel's monomials; where that exceeds 60 (Wendland C4
/// and C6, not the splines) the outer part of the kernel is a ring integrated by Gauss–Legendre rules, which are exact
/// to rounding there. Measured: γ and h∇γ within 4·10⁻¹⁴ of quadrature for all built-in kernels. The wall must be
/// closed within the support. Source: the divergence theorem applied to the definitions (2.63) and (2.64) of
/// Ghaïtanellis (2017); for Wendland C2, ∫ w dS is its Eq. (2.73) with 7/192 in place of 7/129.
#[derive(Clone, Debug)]
pub struct Renormalisation2d {
    kernel_radius: f64,
    pub(super) per_h: f64,
    /// Support over h.
    pub(super) support: f64,
    /// Discs of the closed form, from the outermost inwards.
    pub(super) knots: Vec<Knot>,
    /// The part by quadrature.
    pub(super) rings: Vec<Ring>,
}

impl Renormalisation2d {
    /// Coefficient tables for a kernel shape and the smoothing length h in metres.
    ///
    /// # Errors
    /// A smoothing length that is not positive, or breaks and pieces that do not fit together or
    /// have no positive integral over the plane.
    pub fn new(shape: &PiecewisePolynomial, smoothing_length: f64) -> Result<Self> {
        let sigma = normalisation(shape, smoothing_length, 2)?;
        let (knots, rings) = tables(shape, sigma);
        let (per_h, support) = (1.0 / smoothing_length, shape.support());
        Ok(Self {
            kernel_radius: support * smoothing_length,
            per_h,
            support,
            knots,
            rings,
        })
    }

    /// Distance beyond which the kernel vanishes, m.
    pub fn kernel_radius(&self) -> f64 {
        self.kernel_radius
    }
}

/// Below this distance over h the logarithmic terms, of order a² ln a, are left out.
const NO_LOGARITHM: f64 = 1e-30;

/// Position of a point on a segment.
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

/// The share of one segment in γ and ∇γ of one point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SegmentIntegral {
    /// ∫_s w dS: ∇Γ_as is this times the inward normal, 1/m.
    pub kernel: f64,
    /// Γ_as, to be subtracted from θ; positive for a point on the fluid's side.
    pub gamma: f64,
    /// Position of the point on the segment.
    pub contact: Contact,
}

/// A segment in the frame of its line, everything over h.
#[derive(Clone, Copy, Debug)]
pub(super) struct OnLine<L> {
    /// a: signed distance of the point from the line.
    pub height: L,
    /// Abscissae of both ends.
    pub along: [L; 2],
    /// Squared distances of both ends.
    pub distance2: [L; 2],
}

impl Renormalisation2d {
    /// Integrals over the segment from `start` to `end`, both relative to the point, m.
    ///
    /// `normal` is the inward unit normal, on the left of start → end. Segments that share a vertex
    /// must be given bitwise the same vector to it: then the angles under which they are seen add
    /// up to rounding however close the point is to that vertex.
    #[inline]
    pub fn segment(&self, start: [f64; 2], end: [f64; 2], normal: [f64; 2]) -> SegmentIntegral {
        let seen = self.on_line(start, end, normal);
        self.finished(&seen, self.discs(&seen))
    }

    #[inline(always)]
    pub(super) fn on_line(&self, start: [f64; 2], end: [f64; 2], normal: [f64; 2]) -> OnLine<f64> {
        let (x1, y1) = (start[0] * self.per_h, start[1] * self.per_h);
        let (x2, y2) = (end[0] * self.per_h, end[1] * self.per_h);
        let (r1, r2) = (x1 * x1 + y1 * y1, x2 * x2 + y2 * y2);
        // The nearer end gives the distance to the line with an error relative to its own distance.
        let (x, y) = if r1 < r2 { (x1, y1) } else { (x2, y2) };
        OnLine {
            height: -(x * normal[0] + y * normal[1]),
            along: [
                x1 * normal[1] - y1 * normal[0],
                x2 * normal[1] - y2 * normal[0],
            ],
            distance2: [r1, r2],
        }
    }

    /// The discs of the closed form: h ∫ w dS and Γ, several segments side by side.
    #[inline(always)]
    pub(super) fn discs<L: Lane>(&self, seen: &OnLine<L>) -> [L; 2] {
        let (a, zero) = (seen.height, L::splat(0.0));
        let (a2, depth) = (a * a, a.abs());
        let [y1, y2] = seen.along;
        let [q1, q2] = [seen.distance2[0].sqrt(), seen.distance2[1].sqrt()];
        let (mut kernel, mut gamma, mut smooth) = (zero, zero, zero);
        for knot in &self.knots {
            let rho = L::splat(knot.radius);
            // Half of the chord that the disc cuts out of the line; without a chord the segment is out of reach.
            let reach = ((rho - depth).max(zero) * (rho + depth)).sqrt();
            let inside = [rho - q1, rho - q2];
            let clipped = |inside: L, y: L, q: L, at: L| End {
                y: inside.where_positive(y, at),
                q: inside.where_positive(q, rho),
            };
            let from = clipped(inside[0], y1, q1, zero - reach);
            let to = clipped(inside[1], y2, q2, reach);
            let angle = atan2(a * (to.y - from.y), from.y * to.y + a2);
            let log = logarithm(depth, from, to);
            let p = knot.between(a2, from, to);
            // Beyond an end that is clipped there is nothing, and nothing where the disc does not reach the line.
            let ahead = inside[0].where_positive(L::splat(1.0), zero - y1);
            let behind = inside[1].where_positive(L::splat(1.0), y2);
            let counts = |sum: L, more: L| {
                let more = ahead.where_positive(behind.where_positive(more, zero), zero);
                sum + (rho - depth).where_positive(more, zero)
            };
            kernel = counts(kernel, p.gradient + p.gradient_log * log);
            smooth = counts(smooth, p.gamma + p.gamma_log * log);
            gamma = counts(gamma, L::splat(knot.angle) * angle);
        }
        [kernel, gamma - a * smooth]
    }

    #[inline(always)]
    pub(super) fn finished(&self, seen: &OnLine<f64>, discs: [f64; 2]) -> SegmentIntegral {
        let (a, t) = (seen.height, seen.along);
        let [mut kernel, mut gamma] = discs;
        for ring in &self.rings {
            if a.abs() < ring.outer && t[0] < ring.outer && t[1] > -ring.outer {
                let [f, k] = ring.integrals(a, t[0], t[1]);
                kernel += f;
                gamma += a * k;
            }
        }
        let contact = contact(a, t, seen.distance2);
        SegmentIntegral {
            kernel: kernel * self.per_h,
            gamma: if contact == Contact::None { gamma } else { 0.0 },
            contact,
        }
    }
}

/// asinh(y₂/a) − asinh(y₁/a) with one logarithm and without cancellation.
#[inline(always)]
fn logarithm<L: Lane>(depth: L, from: End<L>, to: End<L>) -> L {
    let zero = L::splat(0.0);
    let (far_from, far_to) = (from.y.abs() + from.q, to.y.abs() + to.q);
    // Both ends behind the foot, both before it, or the foot between them.
    let behind = zero - from.y;
    let over = to.y.where_positive(far_to * far_from, far_from);
    let over = behind.where_positive(over, far_to);
    let under = to.y.where_positive(depth * depth, far_to);
    let under = behind.where_positive(under, far_from);
    let seen = depth - L::splat(NO_LOGARITHM);
    let one = L::splat(1.0);
    let ratio = seen.where_positive(over, one) / seen.where_positive(under, one);
    seen.where_positive(ln(ratio), zero)
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

/// Segments in reach of the points that see them, one after the other; kept for its memory.
#[derive(Debug, Default)]
pub struct SegmentBatch {
    height: Vec<f64>,
    along: [Vec<f64>; 2],
    distance2: [Vec<f64>; 2],
    /// h ∫ w dS and Γ of the discs.
    discs: [Vec<f64>; 2],
    /// The segment, and the height of the point over its line, m.
    pub(crate) seen: Vec<(u32, f64)>,
    /// Segments up to and including each point's.
    pub(crate) ends: Vec<usize>,
}

impl SegmentBatch {
    pub(crate) fn clear(&mut self) {
        let [along, distance2] = [&mut self.along, &mut self.distance2];
        let all = along.iter_mut().chain(distance2);
        all.chain([&mut self.height]).for_each(Vec::clear);
        self.seen.clear();
        self.ends.clear();
    }

    pub(crate) fn end(&mut self) {
        self.ends.push(self.seen.len());
    }

    #[inline(always)]
    fn at(&self, k: usize) -> OnLine<f64> {
        OnLine {
            height: self.height[k],
            along: [self.along[0][k], self.along[1][k]],
            distance2: [self.distance2[0][k], self.distance2[1][k]],
        }
    }
}

impl Renormalisation2d {
    /// Adds a segment if it is in reach; arguments as of [`segment`](Renormalisation2d::segment).
    #[inline(always)]
    pub(crate) fn see(
        &self,
        batch: &mut SegmentBatch,
        segment: u32,
        ends: [[f64; 2]; 2],
        normal: [f64; 2],
    ) {
        let seen = self.on_line(ends[0], ends[1], normal);
        let support = self.support;
        if seen.height.abs() >= support || seen.along[0] >= support || seen.along[1] <= -support {
            return;
        }
        batch.height.push(seen.height);
        for k in 0..2 {
            batch.along[k].push(seen.along[k]);
            batch.distance2[k].push(seen.distance2[k]);
        }
        let distance = -(normal[0] * ends[0][0] + normal[1] * ends[0][1]);
        batch.seen.push((segment, distance));
    }

    pub(crate) fn weigh(&self, batch: &mut SegmentBatch) {
        // The last vector is filled up with segments out of reach.
        let all = batch.height.len();
        let full = all.next_multiple_of(MOST);
        let away = 2.0 * self.support;
        batch.height.resize(full, away);
        for k in 0..2 {
            batch.along[k].resize(full, 0.0);
            batch.distance2[k].resize(full, away * away);
            batch.discs[k].resize(full, 0.0);
        }
        dispatch(Discs {
            integrals: self,
            batch,
        });
    }

    #[inline(always)]
    pub(crate) fn weighed(&self, batch: &SegmentBatch, k: usize) -> SegmentIntegral {
        self.finished(&batch.at(k), [batch.discs[0][k], batch.discs[1][k]])
    }
}

struct Discs<'a> {
    integrals: &'a Renormalisation2d,
    batch: &'a mut SegmentBatch,
}

impl Body for Discs<'_> {
    type Output = ();

    #[inline(always)]
    fn call<L: Lane>(self) {
        let SegmentBatch {
            height,
            along,
            distance2,
            discs,
            ..
        } = self.batch;
        for from in (0..height.len()).step_by(L::N) {
            let [y1, y2] = along;
            let [q1, q2] = distance2;
            let seen = OnLine {
                height: L::load(&height[from..]),
                along: [L::load(&y1[from..]), L::load(&y2[from..])],
                distance2: [L::load(&q1[from..]), L::load(&q2[from..])],
            };
            let [kernel, gamma] = self.integrals.discs(&seen);
            kernel.store(&mut discs[0][from..]);
            gamma.store(&mut discs[1][from..]);
        }
    }
}
