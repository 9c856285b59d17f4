//! γ and ∇γ in closed form, of kernels that can be integrated.

pub(crate) mod gamma;
pub(crate) mod spatial;

use sph_kernels::{PiecewisePolynomial, algebra};

use crate::integrals::gamma::{Contact, Renormalisation2d, SegmentIntegral};
use crate::{BoundaryError, ElementTree, FacetIntegral, Mesh, Renormalisation3d, Result};

/// σ of a kernel shape that can be integrated, with a smoothing length h, m, that is one.
///
/// # Errors
/// A smoothing length that is not positive, or breaks and pieces that do not fit together or have no positive integral.
pub(crate) fn normalisation(
    shape: &PiecewisePolynomial,
    smoothing_length: f64,
    dimension: usize,
) -> Result<f64> {
    BoundaryError::check_positive("smoothing length", smoothing_length)?;
    shape.check().map_err(BoundaryError::kernel)?;
    let sigma = shape.normalisation(dimension);
    match sigma > 0.0 && sigma.is_finite() {
        true => Ok(sigma),
        false => Err(BoundaryError::kernel(format!(
            "its integral in {dimension} dimensions is not positive"
        ))),
    }
}

/// Knots where the polynomial changes and by how much, from the outermost inwards.
pub(crate) fn steps(shape: &PiecewisePolynomial) -> Vec<(f64, Vec<f64>)> {
    let mut steps = Vec::with_capacity(shape.pieces.len());
    let mut outside: &[f64] = &[];
    for (piece, bounds) in shape.pieces.iter().zip(shape.breaks.windows(2)).rev() {
        let step = algebra::sum(piece, &algebra::scaled(outside, -1.0));
        outside = piece;
        if step.iter().any(|c| *c != 0.0) {
            steps.push((bounds[1], step));
        }
    }
    steps
}

/// One end of a clipped segment or edge: abscissa y on its line and distance q, over h.
#[derive(Clone, Copy)]
pub(crate) struct End<L> {
    pub y: L,
    pub q: L,
}

/// A γ below this is taken for its other representative, 1 + γ.
const SURELY_FLUID: f64 = 1e-9;

/// Sums over the segments or facets around one point.
///
/// # Which θ
/// γ = θ − Σ Γ_as, where θ is the fluid angle at the point over 2π, the solid angle over 4π: 1 in the fluid, 0 outside, 1/2
/// on a segment, θ_v on a corner; the integrals over facets never touch the point. Deciding by the side of a wall on which a point lies is fragile
/// within rounding of the wall and wrong near corners and plates. It is not needed: θ is known up to
/// a whole number, and γ = ∫_Ω w dV of a kernel w ≥ 0 lies between 0 and 1. So
///
/// ```text
/// γ = x − ⌊x⌋,   x = Σ θ_contact − Σ Γ_as,   taken in [10⁻⁹, 1 + 10⁻⁹)
/// ```
///
/// θ_contact being 1/2 for each segment the point lies on and θ_v for each corner it coincides with. A point just
/// inside has Σ Γ ≈ +1/2 and takes θ = 1, one a rounding error outside has −1/2 and takes θ = 0, one exactly on the
/// wall has 0 and takes 1/2: γ = 1/2 in all three cases, and the same holds at corners, on plates of any thickness,
/// zero included (1/2 + 1/2 = 1), and where several walls touch. At the ambiguous end γ = 0 or 1, the point is taken to
/// be in the fluid: a point outside and out of reach of every wall has γ = 1, as has one in the fluid. Use
/// [`Mesh::contains`] to find particles that left. Equally, a fluid wedge narrower than 10⁻⁹ · 2π, or a corner of a
/// solid angle below 10⁻⁹ · 4π, is not seen.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GammaSum<const D: usize> {
    /// Σ Γ_as over the elements that do not contain the point.
    pub signed_sum: f64,
    /// ∇γ = Σ n_s ∫_s w dS, 1/m.
    pub gradient: [f64; D],
    /// Fluid angle over 2π of the segments and corners that contain the point, 0 if there are none.
    pub contact_fraction: f64,
}

impl<const D: usize> Default for GammaSum<D> {
    fn default() -> Self {
        GammaSum {
            signed_sum: 0.0,
            gradient: [0.0; D],
            contact_fraction: 0.0,
        }
    }
}

impl<const D: usize> GammaSum<D> {
    #[inline(always)]
    fn add_integrals(&mut self, gamma: f64, kernel: f64, normal: [f64; D]) {
        self.signed_sum += gamma;
        for (sum, n) in self.gradient.iter_mut().zip(normal) {
            *sum += kernel * n;
        }
    }

    /// γ, with θ found from the sum itself.
    #[inline]
    pub fn gamma(&self) -> f64 {
        let x = self.contact_fraction - self.signed_sum;
        let gamma = x - x.floor();
        if gamma < SURELY_FLUID {
            gamma + 1.0
        } else {
            gamma
        }
    }
}

impl GammaSum<2> {
    /// Adds the contribution of one segment of a mesh.
    #[inline]
    pub fn add(&mut self, integral: &SegmentIntegral, segment: usize, mesh: &Mesh<2>) {
        let segment = &mesh.elements[segment];
        self.add_integrals(integral.gamma, integral.kernel, segment.normal);
        self.contact_fraction += match integral.contact {
            Contact::None => 0.0,
            Contact::Start => mesh.theta_share(segment.nodes[0]),
            Contact::End => mesh.theta_share(segment.nodes[1]),
            Contact::Inside => 0.5,
        };
    }
}

impl GammaSum<3> {
    /// Adds the contribution of one facet with the inward unit normal.
    #[inline]
    pub fn add(&mut self, integral: &FacetIntegral, normal: [f64; 3]) {
        self.add_integrals(integral.gamma, integral.kernel, normal);
    }
}

impl Renormalisation2d {
    /// γ and ∇γ of a point from the segments that `tree` finds around it.
    ///
    /// `tree` must have been built for at least this kernel radius and for the present position of
    /// the walls. With periodic directions the point belongs in the box.
    pub fn at(&self, point: [f64; 2], mesh: &Mesh<2>, tree: &ElementTree<2>) -> GammaSum<2> {
        let mut sum = GammaSum::<2>::default();
        for near in tree.near(mesh, point, self.kernel_radius()) {
            let normal = mesh.elements[near.index()].normal;
            let [start, end] = mesh.corners_from(point, near);
            sum.add(&self.segment(start, end, normal), near.index(), mesh);
        }
        sum
    }
}

impl Renormalisation3d {
    /// The same in space.
    pub fn at(&self, point: [f64; 3], mesh: &Mesh<3>, tree: &ElementTree<3>) -> GammaSum<3> {
        let mut sum = GammaSum::<3>::default();
        for near in tree.near(mesh, point, self.kernel_radius()) {
            let normal = mesh.elements[near.index()].normal;
            let integral = self.triangle(mesh.corners_from(point, near), normal);
            sum.add(&integral, normal);
        }
        sum
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn unusable_kernels_are_refused() {
        let hat = PiecewisePolynomial {
            breaks: vec![0.0, 1.0],
            pieces: vec![vec![1.0, -1.0]],
        };
        let with = |pieces| PiecewisePolynomial {
            pieces,
            ..hat.clone()
        };
        for dimension in [2, 3] {
            let refused =
                |shape: &PiecewisePolynomial, h| normalisation(shape, h, dimension).is_err();
            assert!(!refused(&hat, 0.5) && refused(&hat, 0.0) && refused(&hat, f64::NAN));
            assert!(refused(&with(vec![vec![-1.0]]), 1.0) && refused(&with(vec![]), 1.0));
        }
    }
}
