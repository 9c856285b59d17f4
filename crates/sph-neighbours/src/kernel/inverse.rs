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

#[cfg(test)]
mod tests {
    use nalgebra::{Matrix2, Matrix3};

    use super::*;

    #[test]
    fn it_is_the_inverse() {
        let plane = Matrix2::new(0.9, -0.2, 0.1, 0.7);
        let space = Matrix3::new(0.9, 0.1, 0.0, 0.3, 0.6, -0.2, 0.0, -0.4, 0.7);
        let found = trusted_inverse(&plane).expect("neighbours all around");
        assert!((found * plane - Matrix2::identity()).norm() < 1e-15);
        let found = trusted_inverse(&space).expect("neighbours all around");
        assert!((found * space - Matrix3::identity()).norm() < 1e-14);
    }

    /// det over that of an even moment of the same trace is 4q/(1 + q)² for diag(1, q), and 27q/(2 + q)³ for diag(1, 1, q).
    #[test]
    fn neighbours_in_a_line_or_a_plane_are_not_trusted() {
        for (q, trusted) in [(1.0, true), (0.0133, true), (0.0122, false), (0.0, false)] {
            let found = trusted_inverse(&Matrix2::new(1.0, 0.0, 0.0, q));
            assert_eq!(found.is_some(), trusted, "{q}");
        }
        for (q, trusted) in [(1.0, true), (0.0156, true), (0.0147, false), (0.0, false)] {
            let found = trusted_inverse(&Matrix3::from_diagonal(&[1.0, 1.0, q].into()));
            assert_eq!(found.is_some(), trusted, "{q}");
        }
        assert!(
            trusted_inverse(&Matrix2::new(0.0, 1.0, 1.0, 0.0)).is_none(),
            "inside out"
        );
    }
}
