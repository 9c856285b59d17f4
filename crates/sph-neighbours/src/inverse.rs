//! Inverses of moments Σ r ⊗ weight.

use nalgebra::SMatrix;

/// Least determinant of the moment, over that of an even one with the same trace.
const LEAST: f64 = 0.05;

/// The inverse of a moment, unless neighbours are nearly in one line or plane.
pub fn trusted_inverse<const D: usize>(moment: &SMatrix<f64, D, D>) -> Option<SMatrix<f64, D, D>> {
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
