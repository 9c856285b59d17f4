//! The kernel's tables for wall integrals in space.

use std::sync::Arc;

use sph_kernels::{PiecewisePolynomial, Sampler, polynomial_sampler};

use super::knot::{self, Knot};
use super::outer_moment::OuterMoment;
use crate::error::Result;
use crate::integrals::normalisation::normalisation;

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
