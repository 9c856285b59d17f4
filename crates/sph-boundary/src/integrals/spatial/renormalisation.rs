//! The integrals of a kernel over planar facets.

use std::f64::consts::PI;
use std::sync::Arc;

use sph_kernels::{PiecewisePolynomial, Sampler, polynomial_sampler};

use super::edge::{Clip, Edge, Winding};
use super::knot::{self, Knot, OuterMoment};
use crate::error::Result;
use crate::geometry::vector::{Point, along, cross, dot};
use crate::integrals::normalisation;

/// Exact wall integrals of one kernel in three dimensions.
///
/// With the vector **r** from the point a to the wall, n the inward normal and w the kernel,
///
/// ```text
/// γ_a = ∫_Ω w dV = θ_a − Σ_s Γ_as,                  ∇γ_a = Σ_s n_s ∫_s w dS
/// Γ_as = (a/4π) ∫_s K(q)/q³ dA,                     K(q) = 4πσ ∫_q^∞ f s² ds,   K(0) = 1
/// ```
///
/// because ∇·(K(r) **r**/(4πr³)) = δ − w; all lengths are over h. As in [`Renormalisation2d`](crate::Renormalisation2d)
/// the kernel is a sum over its knots ρ of polynomials Δ(q) = Σ c_n qⁿ that end there. In polar coordinates about the
/// foot of the perpendicular the radial integrals are polynomials in q, because s ds = q dq, and 1/q; what remains is
/// one integral over the angle φ under which the foot sees each edge. On an edge at the signed distance D from the foot
/// (> 0 inside), A² = a² + D², Q = |a|, q² = A² + y²,
///
/// ```text
/// inside ρ    h ∫ w dS ∋ Σ σc_n/(n+2) U_{n+2}
///             4π Γ_as  ∋ sign(a) K_ρ Θ − a Σ 4πσc_n/((n+2)(n+3)) U_{n+2}
/// outside ρ   the same with U_n = (ρⁿ − Qⁿ) φ and Θ = (1 − Q/ρ) φ
///
/// U_n = ∫ (qⁿ − Qⁿ) dφ = D S_{n−2} + Q² U_{n−2},    U_0 = 0,    U_1 = D S_{−1} − Q Θ
/// S_n = ∫ qⁿ dy = (y qⁿ + n A² S_{n−2})/(n + 1),    S_0 = y,    S_{−1} = asinh(y/A)
/// Θ = ∫ (1 − Q/q) dφ = atan[ D y (D² + y²) / ((D² q + Q y²)(q + Q)) ]
/// ```
///
/// with K_ρ = 4πσ ∫₀^ρ Δ q² dq. No term is singular at a = 0 or D = 0, and no difference of large
/// ones is taken; Σ Θ over the edges is the solid angle.
///
/// | symbol | meaning | unit |
/// |---|---|---|
/// | γ, Γ_as, θ | renormalisation factor, a facet's part, fluid's solid angle over 4π | 1 |
/// | ∇γ, ∫ w dS | gradient and a facet's part, along n | 1/m |
/// | a, D, y, q | distance to the plane (> 0 in the fluid), to the edge, abscissa on it, distance; over h | 1 |
///
/// # Touching
/// θ and Γ_as jump where a point touches a facet, their difference γ does not. Everything is therefore evaluated at a
/// point displaced by 10⁻¹⁰ h in one direction that no wall is parallel to; γ changes by less than 10⁻¹⁰, and the
/// displaced point touches nothing. See [`GammaSum`](crate::GammaSum) for θ. Near an edge the facets on both its sides
/// must agree on where it is: pass bitwise the same end points, relative to the point, to both. Otherwise a point that
/// touches the edge sees the rounding of the coordinates over 10⁻¹⁰ h, 10⁻⁵ in γ where an edge is cut on one side only.
/// Corners that are off their plane by ε cost ε/h, touching included.
///
/// Valid for any piecewise polynomial at every distance. Measured for all built-in kernels: γ and h∇γ within 1.1·10⁻¹⁰,
/// all of it the displacement; the closed form at the displaced point is within 4·10⁻¹⁵ of quadrature for the splines
/// and Wendland C2, 1.3·10⁻¹⁴ for C4, 1.2·10⁻¹³ for C6, whose monomials cancel. The wall must be closed within the
/// support. Source: the divergence theorem applied to the definitions (2.63) and (2.64) of Ghaïtanellis (2017), who
/// gives no closed form in 3D; Violeau et al. (2014) have longer ones.
#[derive(Clone, Debug)]
pub struct Renormalisation3d {
    kernel_radius: f64,
    pub(super) per_h: f64,
    /// Support over h.
    pub(super) support: f64,
    /// From the outermost inwards.
    pub(super) knots: Vec<Knot>,
    pub(super) outer: OuterMoment,
    /// w itself, for quadrature.
    pub(super) kernel: Arc<dyn Sampler>,
}

impl Renormalisation3d {
    /// Coefficient tables for a kernel shape and the smoothing length h in metres.
    ///
    /// # Errors
    /// A smoothing length that is not positive, or breaks and pieces that do not fit together or
    /// have no positive integral over space.
    pub fn new(shape: &PiecewisePolynomial, smoothing_length: f64) -> Result<Self> {
        let sigma = normalisation(shape, smoothing_length, 3)?;
        Ok(Self {
            kernel_radius: shape.support() * smoothing_length,
            per_h: 1.0 / smoothing_length,
            support: shape.support(),
            knots: knot::tables(shape, sigma),
            outer: OuterMoment::new(shape, sigma),
            kernel: polynomial_sampler(shape, 3, smoothing_length).into(),
        })
    }

    /// Distance beyond which the kernel vanishes, m.
    pub fn kernel_radius(&self) -> f64 {
        self.kernel_radius
    }
}

/// The point's displacement over h, 10⁻¹⁰ long and along no simple direction.
const DISPLACEMENT: Point = [
    0.473_205_080_756_9e-10,
    0.618_033_988_749_9e-10,
    0.627_693_841_720_3e-10,
];

/// The share of one facet in γ and ∇γ of one point.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct FacetIntegral {
    /// ∫_s w dS: ∇Γ_as is this times the inward normal, 1/m.
    pub kernel: f64,
    /// Γ_as, to be subtracted from θ; positive for a point on the fluid's side.
    pub gamma: f64,
    /// ∫_s ρ w dS, ρ the vector from the foot of the point, within 10⁻⁴ of h ∫_s w dS.
    pub moment: [f64; 3],
}

impl Renormalisation3d {
    /// Integrals over a planar polygon, which may have holes and several parts.
    ///
    /// `edges` are the directed edges of its boundary in any order, each from start to end relative
    /// to the point, m, with the polygon on the left as seen from the tip of `normal`, the inward
    /// unit normal. `height` is the signed distance of the point from the plane, m, positive on the
    /// side of `normal`. Polygons that share an edge must be given bitwise the same corners.
    ///
    /// An edge out of reach costs a twentieth of a near one, a plane out of reach nothing.
    pub fn polygon(
        &self,
        height: f64,
        normal: [f64; 3],
        edges: impl Iterator<Item = [[f64; 3]; 2]>,
    ) -> FacetIntegral {
        let height = height * self.per_h + dot(DISPLACEMENT, normal);
        if height.abs() >= self.support {
            return FacetIntegral::default();
        }
        let mut facet = Facet::new(self, height, normal);
        for [start, end] in edges {
            facet.add(self.seen(start), self.seen(end));
        }
        facet.integral()
    }

    /// Integrals over a triangle, its corners relative to the point, m, and counter-clockwise about
    /// the inward unit normal. Triangles that share an edge must be given bitwise the same corners.
    #[inline]
    pub fn triangle(&self, corners: [[f64; 3]; 3], normal: [f64; 3]) -> FacetIntegral {
        let [a, b, c] = corners;
        let (a, b, c) = (self.seen(a), self.seen(b), self.seen(c));
        let squares = [dot(a, a), dot(b, b), dot(c, c)];
        // The nearest corner gives the height with an error relative to its own distance.
        let mut nearest = if squares[0] <= squares[1] { 0 } else { 1 };
        if squares[2] < squares[nearest] {
            nearest = 2;
        }
        let height = -dot([a, b, c][nearest], normal);
        if height.abs() >= self.support {
            return FacetIntegral::default();
        }
        let mut facet = Facet::new(self, height, normal);
        facet.add(a, b);
        facet.add(b, c);
        facet.add(c, a);
        facet.integral()
    }

    /// A vector to the wall over h, from the displaced point.
    #[inline(always)]
    fn seen(&self, r: Point) -> Point {
        let at = |i: usize| r[i] * self.per_h - DISPLACEMENT[i];
        [at(0), at(1), at(2)]
    }
}

struct Facet<'a> {
    of: &'a Renormalisation3d,
    normal: Point,
    /// a, and Q = |a|.
    height: f64,
    depth: f64,
    /// h ∫ w dS, and 4π Γ_as = ± `solid` + a `smooth`.
    kernel: f64,
    solid: f64,
    smooth: f64,
    moment: Point,
    /// φ of the edges outside the support.
    far: Winding,
    nearest: f64,
    /// a as the nearest edge has it, which decides the sign.
    side: f64,
}

impl<'a> Facet<'a> {
    #[inline]
    fn new(of: &'a Renormalisation3d, height: f64, normal: Point) -> Self {
        Self {
            of,
            normal,
            height,
            depth: height.abs(),
            kernel: 0.0,
            solid: 0.0,
            smooth: 0.0,
            moment: [0.0; 3],
            far: Winding::NONE,
            nearest: f64::INFINITY,
            side: height,
        }
    }

    /// Adds the edge between two corners relative to the point, over h.
    #[inline]
    fn add(&mut self, start: Point, end: Point) {
        let along = along(end, -1.0, start);
        let l2 = dot(along, along);
        if l2 == 0.0 {
            return;
        }
        let r2 = [dot(start, start), dot(end, end)];
        let to_foot = -dot(start, along);
        let support2 = self.of.support * self.of.support;
        let far = if to_foot <= 0.0 {
            r2[0] >= support2
        } else if to_foot >= l2 {
            r2[1] >= support2
        } else {
            r2[0] * l2 - to_foot * to_foot >= support2 * l2
        };
        if far {
            // On the plane: the height is the same for both corners.
            let cos = dot(start, end) - self.height * self.height;
            self.far.add(cos, dot(self.normal, cross(start, end)));
        } else {
            self.add_near(Edge::seen([start, end], r2, along, l2, self.normal));
        }
    }

    #[inline]
    fn add_near(&mut self, edge: Edge) {
        if edge.distance2 < self.nearest {
            (self.nearest, self.side) = (edge.distance2, edge.height);
        }
        let support = self.of.support;
        let ends = match edge.clip(support, support * support) {
            Clip::Outside => None,
            Clip::Inside => Some([edge.from.y, edge.to.y]),
            Clip::Between(from, to) => Some([from.y, to.y]),
        };
        if let Some([from, to]) = ends {
            let outer = self.of.outer.along(edge.a2, from, to);
            self.moment = along(self.moment, outer, edge.inward);
        }
        // Angle and logarithm of the whole edge serve every knot that does not clip it.
        let (mut whole, mut angle) = (None, None);
        for knot in &self.of.knots {
            if self.depth >= knot.radius {
                break;
            }
            let (from, to, outside) = match edge.clip(knot.radius, knot.radius_squared) {
                Clip::Outside => {
                    let angle = *angle.get_or_insert_with(|| edge.angle());
                    self.add_outside(knot, angle);
                    continue;
                }
                Clip::Inside => (edge.from, edge.to, 0.0),
                Clip::Between(from, to) => (from, to, edge.angle_outside(from, to)),
            };
            let (solid, log) = if outside == 0.0 {
                let at = || (edge.solid_angle(from, to), edge.logarithm(from, to));
                *whole.get_or_insert_with(at)
            } else {
                self.add_outside(knot, outside);
                (edge.solid_angle(from, to), edge.logarithm(from, to))
            };
            let p = knot.between(self.depth, edge.a2, from, to);
            let sum =
                |i: usize| edge.offset * (p.plain[i] + p.logarithm[i] * log) - p.angle[i] * solid;
            self.kernel += sum(0);
            self.smooth += sum(1);
            self.solid += knot.charge * solid;
        }
    }

    #[inline]
    fn add_outside(&mut self, knot: &Knot, angle: f64) {
        let [kernel, smooth] = knot.outside(self.depth);
        self.kernel += kernel * angle;
        self.smooth += smooth * angle;
        self.solid += knot.charge * (1.0 - self.depth / knot.radius) * angle;
    }

    #[inline]
    fn integral(mut self) -> FacetIntegral {
        let far = self.far.angle();
        if far != 0.0 {
            for knot in &self.of.knots {
                if self.depth >= knot.radius {
                    break;
                }
                self.add_outside(knot, far);
            }
        }
        let solid = self.solid.copysign(self.solid * self.side);
        FacetIntegral {
            kernel: self.kernel * self.of.per_h,
            gamma: (solid + self.height * self.smooth) / (4.0 * PI),
            moment: self.moment,
        }
    }
}
