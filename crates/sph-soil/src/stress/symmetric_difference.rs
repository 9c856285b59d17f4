//! The gradient of the semi-analytical walls, as printed.

use nalgebra::SMatrix;
use sph_core::plugin;

use crate::stress::{NeighbourSums, VelocityGradient, VelocityGradientEntry};

/// G_a = 1/γ_a [Σ_b θ_b V_b (u_b − u_a) ⊗ ∇w_ab − Σ_s (u_s − u_a) ⊗ ∇γ_as].
///
/// Too small by up to a half at a free surface, where neighbours are missing.
///
/// Source: Ghaïtanellis 2017, Eq. 4.90, with V_b for V_a.
///
/// ```toml
/// [velocity-gradient.symmetric-difference]
/// ```
#[plugin(VelocityGradientEntry [2, 3], "symmetric-difference", "the plain sum over γ; too small at free surfaces",
    source: "Ghaïtanellis 2017, Eq. 4.90", cfg(not(test)))]
pub struct SymmetricDifference {}

impl<const D: usize> VelocityGradient<D> for SymmetricDifference {
    fn gradient(&self, sums: &NeighbourSums<D>) -> SMatrix<f64, D, D> {
        sums.velocity * sums.inverse_renormalisation
    }
}
