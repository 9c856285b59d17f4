//! Schoenberg's B-splines used as radial kernels.

use crate::algebra::{power, scaled, sum};
use crate::{PiecewisePolynomial, PolynomialKernel};

/// Cubic spline M4, support 2h.
///
/// f(q) = ¼ (2 − q)₊³ − (1 − q)₊³, that is 1 − 3/2 q² + 3/4 q³ for q < 1; twice continuously
/// differentiable. σ_d = 2/3, 10/(7π), 1/π for d = 1, 2, 3.
///
/// The Fourier transform has negative lobes in two and three dimensions (lowest ŵ/ŵ(0):
/// −6.4·10⁻⁴ at kh = 7.3 and −6.0·10⁻⁴ at 7.9): particles pair when they have too many
/// neighbours.
///
/// Source: Monaghan & Lattanzio (1985), A&A 149, 135, eq. (21); Price (2012), doi:10.1016/j.jcp.2010.12.011.
///
/// ```
/// use sph_kernels::Kernel;
/// assert_eq!(sph_kernels::cubic_spline().value(1.0), 0.25);
/// ```
pub fn cubic_spline() -> PolynomialKernel {
    spline(
        "cubic-spline",
        "Monaghan & Lattanzio (1985), A&A 149, 135, eq. (21)",
        3,
        &[(2.0, 0.25), (1.0, -1.0)],
    )
}

/// Quartic spline M5, support 2.5h.
///
/// f(q) = (5/2 − q)₊⁴ − 5 (3/2 − q)₊⁴ + 10 (1/2 − q)₊⁴; three times continuously
/// differentiable. σ_d = 1/24, 96/(1199π), 1/(20π) for d = 1, 2, 3.
///
/// Negative lobes of the Fourier transform, already in 1D (2D: −1.9·10⁻⁴ at kh = 9.5, 3D:
/// −7.9·10⁻⁵ at 9.9), see [`cubic_spline`].
///
/// Source: Schoenberg (1946), Q. Appl. Math. 4; Price (2012), doi:10.1016/j.jcp.2010.12.011.
///
/// ```
/// use sph_kernels::Kernel;
/// assert_eq!(sph_kernels::quartic_spline().value(1.5), 1.0);
/// ```
pub fn quartic_spline() -> PolynomialKernel {
    spline(
        "quartic-spline",
        "Schoenberg (1946), Q. Appl. Math. 4; Price (2012), doi:10.1016/j.jcp.2010.12.011",
        4,
        &[(2.5, 1.0), (1.5, -5.0), (0.5, 10.0)],
    )
}

/// Quintic spline M6, support 3h.
///
/// f(q) = (3 − q)₊⁵ − 6 (2 − q)₊⁵ + 15 (1 − q)₊⁵; four times continuously differentiable.
/// σ_d = 1/120, 7/(478π), 1/(120π) for d = 1, 2, 3.
///
/// Negative lobes of the Fourier transform in two and three dimensions (−2.5·10⁻⁵ at
/// kh = 7.6, −2.2·10⁻⁵ at 8.1), see [`cubic_spline`].
///
/// Source: Schoenberg (1946), Q. Appl. Math. 4; Price (2012), doi:10.1016/j.jcp.2010.12.011.
///
/// ```
/// use sph_kernels::Kernel;
/// assert_eq!(sph_kernels::quintic_spline().value(0.0), 66.0);
/// ```
pub fn quintic_spline() -> PolynomialKernel {
    spline(
        "quintic-spline",
        "Schoenberg (1946), Q. Appl. Math. 4; Price (2012), doi:10.1016/j.jcp.2010.12.011",
        5,
        &[(3.0, 1.0), (2.0, -6.0), (1.0, 15.0)],
    )
}

/// Σ weight (edge − q)₊ⁿ over the (edge, weight) list, edges descending.
fn spline(
    name: &'static str,
    source: &'static str,
    n: usize,
    terms: &[(f64, f64)],
) -> PolynomialKernel {
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
    PolynomialKernel::new(name, source, PiecewisePolynomial { breaks, pieces })
}
