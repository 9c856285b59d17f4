//! γ and ∇γ in closed form, of kernels that can be integrated.

pub(crate) mod gamma;
pub(crate) mod spatial;
pub(crate) mod sum;

use crate::{BoundaryError, Result};
use sph_kernels::{PiecewisePolynomial, algebra};

/// σ of a kernel shape that can be integrated, with a smoothing length h, m, that is one.
///
/// # Errors
/// A smoothing length that is not positive, or breaks and pieces that do not fit together or have no positive integral.
pub(crate) fn normalisation(
    shape: &PiecewisePolynomial,
    smoothing_length: f64,
    dimension: usize,
) -> Result<f64> {
    BoundaryError::check_positive("smoothing length", smoothing_length)?;
    shape.check().map_err(BoundaryError::kernel)?;
    let sigma = shape.normalisation(dimension);
    match sigma > 0.0 && sigma.is_finite() {
        true => Ok(sigma),
        false => Err(BoundaryError::kernel(format!(
            "its integral in {dimension} dimensions is not positive"
        ))),
    }
}

/// Knots where the polynomial changes and by how much, from the outermost inwards.
pub(crate) fn steps(shape: &PiecewisePolynomial) -> Vec<(f64, Vec<f64>)> {
    let mut steps = Vec::with_capacity(shape.pieces.len());
    let mut outside: &[f64] = &[];
    for (piece, bounds) in shape.pieces.iter().zip(shape.breaks.windows(2)).rev() {
        let step = algebra::sum(piece, &algebra::scaled(outside, -1.0));
        outside = piece;
        if step.iter().any(|c| *c != 0.0) {
            steps.push((bounds[1], step));
        }
    }
    steps
}

/// One end of a clipped segment or edge: abscissa y on its line and distance q, over h.
#[derive(Clone, Copy)]
pub(crate) struct End<L> {
    pub y: L,
    pub q: L,
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn unusable_kernels_are_refused() {
        let hat = PiecewisePolynomial {
            breaks: vec![0.0, 1.0],
            pieces: vec![vec![1.0, -1.0]],
        };
        let with = |pieces| PiecewisePolynomial {
            pieces,
            ..hat.clone()
        };
        for dimension in [2, 3] {
            let refused =
                |shape: &PiecewisePolynomial, h| normalisation(shape, h, dimension).is_err();
            assert!(!refused(&hat, 0.5) && refused(&hat, 0.0) && refused(&hat, f64::NAN));
            assert!(refused(&with(vec![vec![-1.0]]), 1.0) && refused(&with(vec![]), 1.0));
        }
    }
}
