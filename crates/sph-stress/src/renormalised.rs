//! The gradient that is exact for linear velocities.

use nalgebra::SMatrix;
use schemars::JsonSchema;
use serde::Deserialize;
use sph_core::register;

use crate::{Isotropic, NeighbourSums, VelocityGradient, VelocityGradientEntry};

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
#[derive(Clone, Copy, Debug, Default, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Renormalised {
    /// Whether the force of an elastic stress does the work of this gradient: stiffer at free surfaces, and the
    /// energy is kept. Not for walls that slip.
    #[schemars(extend("source" = "Bonet & Lok 1999, §4"))]
    pub adjoint: bool,
}

/// Least determinant of the moment, over that of an even one with the same trace.
const LEAST: f64 = 0.05;

impl<const D: usize> VelocityGradient<D> for Renormalised {
    fn gradient(&self, sums: &NeighbourSums<D>) -> SMatrix<f64, D, D> {
        match trusted(&sums.position) {
            Some(inverse) => sums.velocity * inverse,
            None => Isotropic {}.gradient(sums),
        }
    }

    fn adjoint(&self) -> bool {
        self.adjoint
    }

    fn correction(&self, sums: &NeighbourSums<D>) -> SMatrix<f64, D, D> {
        let gamma = 1.0 / sums.inverse_renormalisation;
        match trusted(&sums.position) {
            Some(inverse) => inverse * gamma,
            None => Isotropic {}.correction(sums),
        }
    }
}

/// The inverse of a moment, unless neighbours are nearly in one line or plane.
pub(crate) fn trusted<const D: usize>(moment: &SMatrix<f64, D, D>) -> Option<SMatrix<f64, D, D>> {
    let even = (moment.trace() / D as f64).powi(D as i32);
    let (inverse, determinant) = inverse(moment)?;
    (determinant > LEAST * even).then_some(inverse)
}

/// Inverse and determinant by cofactors; only two and three dimensions have them.
fn inverse<const D: usize>(m: &SMatrix<f64, D, D>) -> Option<(SMatrix<f64, D, D>, f64)> {
    let cofactor = |i: usize, j: usize| match D {
        2 => {
            let sign = if i == j { 1.0 } else { -1.0 };
            sign * m[(1 - i, 1 - j)]
        }
        _ => {
            let [a, b, c, d] = [(i + 1) % 3, (i + 2) % 3, (j + 1) % 3, (j + 2) % 3];
            m[(a, c)] * m[(b, d)] - m[(a, d)] * m[(b, c)]
        }
    };
    let determinant = (0..D).map(|j| m[(0, j)] * cofactor(0, j)).sum::<f64>();
    let adjugate = SMatrix::from_fn(|i, j| cofactor(j, i) / determinant);
    (determinant > 0.0).then_some((adjugate, determinant))
}

register!(
    VelocityGradientEntry [2, 3],
    Renormalised,
    "renormalised",
    "exact for linear velocities, at free surfaces as well",
    "Randles & Libersky 1996"
);

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
