//! Schoenberg's B-splines used as radial kernels.

use crate::PiecewisePolynomial;
use crate::algebra::{power, scaled, sum};

/// Σ weight (edge − q)₊ⁿ over the (edge, weight) list, edges descending.
pub fn spline(n: usize, terms: &[(f64, f64)]) -> PiecewisePolynomial {
    let mut breaks = vec![0.0];
    let mut pieces = Vec::new();
    for k in (0..terms.len()).rev() {
        let piece = terms[..=k]
            .iter()
            .fold(Vec::new(), |total, &(edge, weight)| {
                sum(&total, &scaled(&power(&[edge, -1.0], n), weight))
            });
        breaks.push(terms[k].0);
        pieces.push(piece);
    }
    PiecewisePolynomial { breaks, pieces }
}
