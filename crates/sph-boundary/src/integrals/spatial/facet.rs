//! The integrals of one planar facet seen from one point.

use std::f64::consts::PI;

use super::Renormalisation3d;
use super::edge::{Clip, Edge};
use super::knot::Knot;
use super::winding::Winding;
use crate::geometry::vector::{Point, along, cross, dot};

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
