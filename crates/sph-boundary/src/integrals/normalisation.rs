//! What makes the integral of a kernel one.

use sph_kernels::PiecewisePolynomial;

use crate::error::BoundaryError;

/// σ of a kernel shape that can be integrated, with a smoothing length h, m, that is one.
///
/// # Errors
/// A smoothing length that is not positive, or breaks and pieces that do not fit together or have
/// no positive integral.
pub(crate) fn normalisation(
    shape: &PiecewisePolynomial,
    smoothing_length: f64,
    dimension: usize,
) -> Result<f64, BoundaryError> {
    BoundaryError::check_positive("smoothing length", smoothing_length)?;
    shape
        .check()
        .map_err(|reason| BoundaryError::Kernel { reason })?;
    let sigma = shape.normalisation(dimension);
    match sigma > 0.0 && sigma.is_finite() {
        true => Ok(sigma),
        false => Err(BoundaryError::Kernel {
            reason: format!("its integral in {dimension} dimensions is not positive"),
        }),
    }
}
