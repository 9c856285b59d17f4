//! The Wendland functions of minimal degree, support 2h.

use crate::algebra::{power, product};
use crate::{PiecewisePolynomial, PolynomialKernel};

/// Wendland C2, the kernel of "fifth order" in USAW work.
///
/// f(q) = (1 − q/2)⁴ (1 + 2q) for q < 2, twice continuously differentiable;
/// f'(q) = −5q (1 − q/2)³. σ_d = 3/4, 7/(4π), 21/(16π) for d = 1, 2, 3.
///
/// Its Fourier transform is positive in one to three dimensions: no pairing instability.
/// This is the function of d = 2, 3 and it is used in 1D too; the field also knows
/// (1 − q/2)³ (1 + 3q/2), which is C2 and of lower degree but positive definite in 1D only.
///
/// Source: Wendland (1995), doi:10.1007/BF02123482; Ghaïtanellis (2017), eqs. (2.17)–(2.19).
///
/// ```
/// use sph_kernels::Kernel;
/// assert_eq!(sph_kernels::wendland_c2().value(1.0), 3.0 / 16.0);
/// ```
pub fn wendland_c2() -> PolynomialKernel {
    wendland(
        "wendland-c2",
        "Wendland (1995), doi:10.1007/BF02123482; Ghaïtanellis (2017), eq. (2.17)",
        4,
        &[1.0, 2.0],
    )
}

/// Wendland C4.
///
/// f(q) = (1 − q/2)⁶ (1 + 3q + 35/12 q²) for q < 2, four times continuously differentiable.
/// 35/12 being no binary fraction, moments are good to 10⁻¹³ instead of the last bit. σ_d = 9/(4π), 495/(256π) for d = 2, 3, and 27/32 for the same function in 1D.
///
/// Positive Fourier transform in one to three dimensions; see [`wendland_c2`] about 1D.
///
/// Source: Wendland (1995), doi:10.1007/BF02123482; Dehnen & Aly (2012),
/// doi:10.1111/j.1365-2966.2012.21439.x, table 1.
///
/// ```
/// use sph_kernels::Kernel;
/// let value = sph_kernels::wendland_c4().value(1.0); // 83/768
/// assert!((value - 83.0 / 768.0).abs() < 1e-15);
/// ```
pub fn wendland_c4() -> PolynomialKernel {
    wendland(
        "wendland-c4",
        "Wendland (1995), doi:10.1007/BF02123482; Dehnen & Aly (2012), table 1",
        6,
        &[1.0, 3.0, 35.0 / 12.0],
    )
}

/// Wendland C6.
///
/// f(q) = (1 − q/2)⁸ (1 + 4q + 25/4 q² + 4q³) for q < 2, six times continuously
/// differentiable. σ_d = 39/(14π), 1365/(512π) for d = 2, 3, and 15/16 for the same function
/// in 1D.
///
/// Positive Fourier transform in one to three dimensions; see [`wendland_c2`] about 1D.
///
/// Source: Wendland (1995), doi:10.1007/BF02123482; Dehnen & Aly (2012),
/// doi:10.1111/j.1365-2966.2012.21439.x, table 1.
///
/// ```
/// use sph_kernels::Kernel;
/// assert_eq!(sph_kernels::wendland_c6().value(1.0), 61.0 / 1024.0);
/// ```
pub fn wendland_c6() -> PolynomialKernel {
    wendland(
        "wendland-c6",
        "Wendland (1995), doi:10.1007/BF02123482; Dehnen & Aly (2012), table 1",
        8,
        &[1.0, 4.0, 6.25, 4.0],
    )
}

/// (1 − q/2)ⁿ times a polynomial on [0, 2).
fn wendland(
    name: &'static str,
    source: &'static str,
    n: usize,
    factor: &[f64],
) -> PolynomialKernel {
    let piece = product(&power(&[1.0, -0.5], n), factor);
    let shape = PiecewisePolynomial {
        breaks: vec![0.0, 2.0],
        pieces: vec![piece],
    };
    PolynomialKernel::new(name, source, shape)
}
