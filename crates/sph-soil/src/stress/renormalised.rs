//! The gradient that is exact for linear velocities.

use nalgebra::SMatrix;
use sph_core::plugin;
use sph_neighbours::trusted_inverse;

use crate::stress::{Isotropic, NeighbourSums, VelocityGradient, VelocityGradientEntry};

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

    #[test]
    fn linear_velocities_are_exact_whatever_the_moment() {
        let moment = Matrix3::new(0.9, 0.1, 0.0, 0.1, 0.4, -0.2, 0.0, -0.2, 0.7);
        let gradient = Matrix3::new(1.0, -2.0, 0.5, 0.3, 0.0, 4.0, -1.0, 2.0, 0.25);
        let sums = NeighbourSums {
            velocity: gradient * moment,
            position: moment,
            inverse_renormalisation: 1.3,
        };
        assert!((Renormalised::default().gradient(&sums) - gradient).norm() < 1e-14);
        let moment = Matrix2::new(0.5, 0.05, 0.05, 1.1);
        let gradient = Matrix2::new(1.0, -2.0, 0.5, 0.3);
        let sums = NeighbourSums {
            velocity: gradient * moment,
            position: moment,
            inverse_renormalisation: 1.0,
        };
        assert!((Renormalised::default().gradient(&sums) - gradient).norm() < 1e-14);
    }

    #[test]
    fn the_correction_makes_the_plain_sum_the_gradient() {
        let moment = Matrix2::new(0.5, 0.05, 0.04, 1.1);
        let row = Matrix2::new(1.0, 0.0, 0.0, 0.0);
        for position in [moment, row, Matrix2::zeros()] {
            let sums = NeighbourSums {
                velocity: Matrix2::new(1.0, -2.0, 0.5, 0.3),
                position,
                inverse_renormalisation: 1.25,
            };
            let law = Renormalised { adjoint: true };
            let plain = sums.velocity * sums.inverse_renormalisation;
            let corrected = plain * law.correction(&sums);
            assert!((corrected - law.gradient(&sums)).norm() < 1e-14);
        }
    }

    #[test]
    fn particles_in_a_row_and_alone_have_finite_gradients() {
        let row = Matrix2::new(1.0, 0.0, 0.0, 0.0);
        for (velocity, position) in [
            (row, row),
            (Matrix2::zeros(), Matrix2::zeros()),
            (row * 1e-300, row * 1e-300),
        ] {
            let gradient = Renormalised::default().gradient(&NeighbourSums {
                velocity,
                position,
                inverse_renormalisation: 1.0,
            });
            assert!(gradient.iter().all(|g| g.is_finite()), "{gradient}");
        }
    }
}
