//! The role of a kernel: a shape of compact support.

use std::fmt::Debug;

use crate::quadrature;
use crate::{PiecewisePolynomial, Sampler};

/// A smoothing kernel as the unnormalised shape f(q), q = r/h ≥ 0, f = 0 for q ≥ support.
///
/// This is the exact description, without dimension and h; loops use [`Kernel::sampler`]. A polynomial kernel is a
/// [`PolynomialKernel`](crate::PolynomialKernel); another one implements five methods and borrows the rest:
///
/// ```
/// use sph_kernels::{Kernel, Sampler, ScalarSampler};
///
/// #[derive(Clone, Debug)]
/// struct Gaussian;
///
/// impl Kernel for Gaussian {
///     fn name(&self) -> &str { "gaussian" }
///     fn source(&self) -> &str { "Gingold & Monaghan (1977), cut at 3 h" }
///     fn support(&self) -> f64 { 3.0 }
///     fn value(&self, q: f64) -> f64 { if q < 3.0 { (-q * q).exp() } else { 0.0 } }
///     fn derivative(&self, q: f64) -> f64 { -2.0 * q * self.value(q) }
///     fn sampler(&self, dimension: usize, h: f64) -> Box<dyn Sampler> {
///         Box::new(ScalarSampler::new(self.clone(), dimension, h))
///     }
/// }
///
/// // 1/√π / erf(3)
/// assert!((Gaussian.normalisation(1) - 0.564_202_047_051_383_0).abs() < 1e-14);
/// assert!((Gaussian.sampler(1, 2.0).value_at_zero() - 0.282_101_023_525_691_5).abs() < 1e-14);
/// ```
pub trait Kernel: Send + Sync + Debug {
    /// Name in scene files, lower case with hyphens.
    fn name(&self) -> &str;

    /// Source of the kernel: paper, equation, DOI.
    fn source(&self) -> &str;

    /// Support radius over h.
    fn support(&self) -> f64;

    /// f(q), dimensionless, 0 for q ≥ support.
    fn value(&self, q: f64) -> f64;

    /// f'(q), dimensionless, 0 for q ≥ support.
    fn derivative(&self, q: f64) -> f64;

    /// The kernel bound to a dimension (1, 2, 3) and the smoothing length h in m.
    ///
    /// # Panics
    /// If the dimension is not 1, 2 or 3 or h is not positive.
    fn sampler(&self, dimension: usize, h: f64) -> Box<dyn Sampler>;

    /// The coefficients, if the shape is polynomial. Walls with closed forms ask for them
    /// and refuse kernels that have none.
    fn polynomial(&self) -> Option<&PiecewisePolynomial> {
        None
    }

    /// σ_d with σ_d ∫ f dV = 1 in d = 1, 2, 3 dimensions, dimensionless.
    ///
    /// Exact for polynomial kernels, otherwise by Gauss quadrature on 64 panels of the
    /// support; override it where f has a kink or a closed form is known.
    ///
    /// # Panics
    /// If the dimension is not 1, 2 or 3.
    fn normalisation(&self, dimension: usize) -> f64 {
        match self.polynomial() {
            Some(shape) => shape.normalisation(dimension),
            None => quadrature::normalisation(|q| self.value(q), self.support(), dimension),
        }
    }
}
