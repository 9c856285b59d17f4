//! A kernel that is nothing but coefficients.

use std::borrow::Cow;

use crate::{Kernel, PiecewisePolynomial, Sampler, polynomial_sampler};

/// A kernel given by a name, a source and its shape.
///
/// ```
/// use sph_kernels::{Kernel, PiecewisePolynomial, PolynomialKernel, algebra};
///
/// // Lucy (1977): (1 + 3q)(1 − q)³ on [0, 1), σ₂ = 5/π.
/// let piece = algebra::product(&[1.0, 3.0], &algebra::power(&[1.0, -1.0], 3));
/// let shape = PiecewisePolynomial { breaks: vec![0.0, 1.0], pieces: vec![piece] };
/// let lucy = PolynomialKernel::new("lucy", "Lucy (1977), doi:10.1086/112164", shape);
/// assert!((lucy.normalisation(2) - 5.0 / std::f64::consts::PI).abs() < 1e-15);
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct PolynomialKernel {
    name: Cow<'static, str>,
    source: Cow<'static, str>,
    shape: PiecewisePolynomial,
}

impl PolynomialKernel {
    /// A kernel from its shape.
    ///
    /// # Panics
    /// If [`PiecewisePolynomial::check`] refuses the shape.
    pub fn new(
        name: impl Into<Cow<'static, str>>,
        source: impl Into<Cow<'static, str>>,
        shape: PiecewisePolynomial,
    ) -> Self {
        let (name, source) = (name.into(), source.into());
        if let Err(reason) = shape.check() {
            panic!("kernel {name}: {reason}");
        }
        Self {
            name,
            source,
            shape,
        }
    }

    /// The shape f(q).
    pub fn shape(&self) -> &PiecewisePolynomial {
        &self.shape
    }
}

impl Kernel for PolynomialKernel {
    fn name(&self) -> &str {
        &self.name
    }
    fn source(&self) -> &str {
        &self.source
    }
    fn support(&self) -> f64 {
        self.shape.support()
    }
    fn value(&self, q: f64) -> f64 {
        self.shape.value(q)
    }
    fn derivative(&self, q: f64) -> f64 {
        self.shape.derivative(q)
    }
    fn sampler(&self, dimension: usize, h: f64) -> Box<dyn Sampler> {
        polynomial_sampler(&self.shape, dimension, h)
    }
    fn polynomial(&self) -> Option<&PiecewisePolynomial> {
        Some(&self.shape)
    }
}
