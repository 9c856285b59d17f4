//! γ of a point from the facets around it, and the decision between inside and outside.

use super::{FacetIntegral, Renormalisation3d};
use crate::geometry::mesh::{Grid, Mesh};

/// A γ below this is taken for its other representative, 1 + γ.
const SURELY_FLUID: f64 = 1e-9;

/// Sums over the facets around one point.
///
/// # Which θ
/// γ = θ − Σ Γ_as with θ = 1 in the fluid and 0 outside; the integrals never touch the point, so
/// there are no other values. Which of the two need not be decided: γ lies between 0 and 1, hence
///
/// ```text
/// γ = x − ⌊x⌋,   x = − Σ Γ_as,   taken in [10⁻⁹, 1 + 10⁻⁹)
/// ```
///
/// as in [`GammaSum`](crate::GammaSum), with the same consequences: a point a rounding error inside
/// or outside of a face, an edge or a corner has the γ of a point on it; a point outside and out of
/// reach of every wall has γ = 1, as has one in the fluid; a fluid corner of a solid angle below
/// 10⁻⁹ · 4π is not seen.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct GammaSum3d {
    /// Σ Γ_as.
    pub signed_sum: f64,
    /// ∇γ = Σ n_s ∫_s w dS, 1/m.
    pub gradient: [f64; 3],
}

impl GammaSum3d {
    /// Adds what one facet with the inward unit normal contributes.
    #[inline]
    pub fn add(&mut self, integral: &FacetIntegral, normal: [f64; 3]) {
        self.signed_sum += integral.gamma;
        for (sum, n) in self.gradient.iter_mut().zip(normal) {
            *sum += integral.kernel * n;
        }
    }

    /// γ, with θ found from the sum itself.
    #[inline]
    pub fn gamma(&self) -> f64 {
        let x = -self.signed_sum;
        let gamma = x - x.floor();
        if gamma < SURELY_FLUID {
            gamma + 1.0
        } else {
            gamma
        }
    }

    /// γ for a θ that is known: 1 in the fluid, 0 outside.
    pub fn gamma_with(&self, theta: f64) -> f64 {
        theta - self.signed_sum
    }
}

impl Renormalisation3d {
    /// γ and ∇γ of a point from the triangles that `grid` finds around it.
    ///
    /// `grid` must have been built for at least this kernel radius and for the present position of
    /// the walls. With periodic directions the point belongs in the box.
    pub fn at(&self, point: [f64; 3], mesh: &Mesh<3>, grid: &Grid<3>) -> GammaSum3d {
        let mut sum = GammaSum3d::default();
        for near in grid.near(mesh, point, self.kernel_radius()) {
            let normal = mesh.elements[near.index()].normal;
            sum.add(
                &self.triangle(mesh.corners_from(point, near), normal),
                normal,
            );
        }
        sum
    }
}
