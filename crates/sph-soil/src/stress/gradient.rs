//! Gradients of the velocity from sums over neighbours.

use nalgebra::SMatrix;
use sph_core::{Work, contract, plugin};
use sph_neighbours::trusted_inverse;

/// Terms of a formula: sums over neighbours, wall points and elements with the weights θ_b V_b ∇w_ab and −∇γ_as.
#[derive(Clone, Copy, Debug)]
pub struct NeighbourSums<const D: usize> {
    /// Σ (u_b − u_a) ⊗ weight, 1/s.
    pub velocity: SMatrix<f64, D, D>,
    /// Σ (r_b − r_a) ⊗ weight: the unit tensor where neighbours surround the particle evenly.
    pub position: SMatrix<f64, D, D>,
    /// 1/γ.
    pub inverse_renormalisation: f64,
}

/// A formula for (grad u)_ij = ∂u_i/∂x_j.
pub trait VelocityGradient<const D: usize>: Send + Sync {
    /// The gradient from the sums, 1/s; zero for a particle without neighbours.
    fn gradient(&self, sums: &NeighbourSums<D>) -> SMatrix<f64, D, D>;
    /// True if the force of an elastic stress is the adjoint of this formula, and not of the plain sum over γ.
    fn adjoint(&self) -> bool {
        false
    }
    /// C in G = 1/γ Σ (u_b − u_a) ⊗ weight C.
    fn correction(&self, _sums: &NeighbourSums<D>) -> SMatrix<f64, D, D> {
        SMatrix::identity()
    }
}

contract!(
    /// A velocity gradient that a scene may name.
    pub VelocityGradientEntry, "velocity-gradient", One, "the strain rate that a law reads", VelocityGradient<D>,
    .by_default("renormalised").ordered(30).works(Work::Others).idle(
        "no law of this scene reads a strain rate, and no output shows one: take this table out"
    )
);

/// G_a = d Σ (u_b − u_a) ⊗ V_b ∇w_ab / Σ (r_b − r_a)·V_b ∇w_ab.
///
/// Exact for linear velocities where the neighbours are spread evenly; at a free surface 17 % too
/// small across it and 17 % too large along it.
///
/// Source: Krimi et al. 2018, Eq. 43–44, with d for 2.
///
/// ```toml
/// [velocity-gradient.isotropic]
/// ```
#[plugin(VelocityGradientEntry [2, 3], "isotropic", "one factor for all directions",
    source: "Krimi et al. 2018, Eq. 43–44", cfg(not(test)))]
pub struct Isotropic {}

impl<const D: usize> VelocityGradient<D> for Isotropic {
    fn gradient(&self, sums: &NeighbourSums<D>) -> SMatrix<f64, D, D> {
        let trace = sums.position.trace();
        match trace > 0.0 {
            true => sums.velocity * (D as f64 / trace),
            false => SMatrix::zeros(),
        }
    }

    fn correction(&self, sums: &NeighbourSums<D>) -> SMatrix<f64, D, D> {
        let trace = sums.position.trace() * sums.inverse_renormalisation;
        match trace > 0.0 {
            true => SMatrix::identity() * (D as f64 / trace),
            false => SMatrix::zeros(),
        }
    }
}

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

/// G_a = [Σ (u_b − u_a) ⊗ V_b ∇w_ab] [Σ (r_b − r_a) ⊗ V_b ∇w_ab]⁻¹.
///
/// Exact for linear velocities on any arrangement, at walls and at free surfaces. Where the
/// neighbours are nearly in one line or plane it is that of [`Isotropic`].
///
/// Source: Randles & Libersky 1996.
///
/// ```toml
/// [velocity-gradient.renormalised]
/// adjoint = true
/// ```
#[plugin(VelocityGradientEntry [2, 3], "renormalised", "exact for linear velocities, at free surfaces as well",
    source: "Randles & Libersky 1996", cfg(not(test)))]
pub struct Renormalised {
    /// True if the force of an elastic stress does the work of this gradient: stiffer at free surfaces, and the energy
    /// is kept. Not for walls that slip.
    #[parameter(default, source: "Bonet & Lok 1999, §4")]
    pub adjoint: bool,
}

impl<const D: usize> VelocityGradient<D> for Renormalised {
    fn gradient(&self, sums: &NeighbourSums<D>) -> SMatrix<f64, D, D> {
        match trusted_inverse(&sums.position) {
            Some(inverse) => sums.velocity * inverse,
            None => Isotropic {}.gradient(sums),
        }
    }

    fn adjoint(&self) -> bool {
        self.adjoint
    }

    fn correction(&self, sums: &NeighbourSums<D>) -> SMatrix<f64, D, D> {
        let gamma = 1.0 / sums.inverse_renormalisation;
        match trusted_inverse(&sums.position) {
            Some(inverse) => inverse * gamma,
            None => Isotropic {}.correction(sums),
        }
    }
}

#[cfg(test)]
mod tests {
    use nalgebra::{Matrix2, Matrix3};

    use super::*;

    fn sums<const D: usize>(
        velocity: SMatrix<f64, D, D>,
        position: SMatrix<f64, D, D>,
        inverse_renormalisation: f64,
    ) -> NeighbourSums<D> {
        NeighbourSums {
            velocity,
            position,
            inverse_renormalisation,
        }
    }

    #[test]
    fn linear_velocities_are_exact_whatever_the_moment() {
        let moment = Matrix3::new(0.9, 0.1, 0.0, 0.1, 0.4, -0.2, 0.0, -0.2, 0.7);
        let gradient = Matrix3::new(1.0, -2.0, 0.5, 0.3, 0.0, 4.0, -1.0, 2.0, 0.25);
        let found = Renormalised::default().gradient(&sums(gradient * moment, moment, 1.3));
        assert!((found - gradient).norm() < 1e-14);
        let moment = Matrix2::new(0.5, 0.05, 0.05, 1.1);
        let gradient = Matrix2::new(1.0, -2.0, 0.5, 0.3);
        let found = Renormalised::default().gradient(&sums(gradient * moment, moment, 1.0));
        assert!((found - gradient).norm() < 1e-14);
    }

    #[test]
    fn the_correction_makes_the_plain_sum_the_gradient() {
        let moment = Matrix2::new(0.5, 0.05, 0.04, 1.1);
        let row = Matrix2::new(1.0, 0.0, 0.0, 0.0);
        for position in [moment, row, Matrix2::zeros()] {
            let sums = sums(Matrix2::new(1.0, -2.0, 0.5, 0.3), position, 1.25);
            let law = Renormalised { adjoint: true };
            let plain = sums.velocity * sums.inverse_renormalisation;
            let corrected = plain * law.correction(&sums);
            assert!((corrected - law.gradient(&sums)).norm() < 1e-14);
        }
    }

    #[test]
    fn particles_in_a_row_and_alone_have_finite_gradients() {
        let row = Matrix2::new(1.0, 0.0, 0.0, 0.0);
        for both in [row, Matrix2::zeros(), row * 1e-300] {
            let gradient = Renormalised::default().gradient(&sums(both, both, 1.0));
            assert!(gradient.iter().all(|g| g.is_finite()), "{gradient}");
        }
    }
}
