//! The gradient by differences that is exact for linear fields, wherever the support is cut.

use sph_core::Vect;
use sph_neighbours::Row;

/// Least eigenvalue, as a share of 1, of the matrix that a gradient is renormalised with.
const LEAST: f64 = 0.05;

/// [Σ_b V_b (r_b − r_a) ⊗ ∇w_ab]⁻¹ Σ_b V_b (A_b − A_a) ∇w_ab over a row of neighbours; nothing where they span no
/// volume. Unit: that of A over metres.
///
/// `rise` gives A_b − A_a, or nothing for a neighbour that does not count.
pub fn linear_exact<const D: usize>(
    row: &Row<'_, D>,
    volume: &[f64],
    rise: impl Fn(usize) -> Option<f64>,
) -> Vect<D> {
    // Columns of the matrix, and its right side.
    let mut matrix = [Vect::<D>::zeros(); D];
    let mut sum = Vect::<D>::zeros();
    for (k, &j) in row.index.iter().enumerate() {
        let j = j as usize;
        if let Some(rise) = rise(j) {
            let slope = row.separation[k] * (volume[j] * row.factor[k]);
            sum += slope * rise;
            for (c, column) in matrix.iter_mut().enumerate() {
                *column -= slope * row.separation[k][c];
            }
        }
    }
    solve(matrix, sum).unwrap_or_else(Vect::zeros)
}

/// The solution of a symmetric positive system by Cholesky's elimination, if every pivot is large enough.
fn solve<const D: usize>(mut matrix: [Vect<D>; D], mut right: Vect<D>) -> Option<Vect<D>> {
    for k in 0..D {
        if matrix[k][k] < LEAST {
            return None;
        }
        for row in k + 1..D {
            let factor = matrix[k][row] / matrix[k][k];
            for column in matrix.iter_mut().skip(k) {
                column[row] -= factor * column[k];
            }
            right[row] -= factor * right[k];
        }
    }
    for k in (0..D).rev() {
        for c in k + 1..D {
            right[k] -= matrix[c][k] * right[c];
        }
        right[k] /= matrix[k][k];
    }
    Some(right)
}
