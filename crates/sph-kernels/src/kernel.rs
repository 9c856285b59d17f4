//! The role of a kernel, a shape of compact support; one of coefficients alone, and the sampler of any other.

use std::fmt::Debug;

use crate::moments::sphere;
use crate::sampler::assert_smoothing_length;
use crate::{PiecewisePolynomial, Sampler, polynomial_sampler};

/// A smoothing kernel as the unnormalised shape f(q), q = r/h ≥ 0, f = 0 for q ≥ support.
///
/// This is the exact description, without dimension and h; loops use [`Kernel::sampler`]. A polynomial kernel is a
/// [`PolynomialKernel`]; another one implements five methods and borrows the rest:
///
/// ```
/// use sph_kernels::{Kernel, Sampler, ScalarSampler};
///
/// #[derive(Clone, Debug)]
/// struct Gaussian; // Gingold & Monaghan (1977), cut at 3 h
///
/// impl Kernel for Gaussian {
///     fn name(&self) -> &str { "gaussian" }
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
            None => by_gauss(|q| self.value(q), self.support(), dimension),
        }
    }
}

/// A kernel given by a name and its shape.
///
/// ```
/// use sph_kernels::{Kernel, PiecewisePolynomial, PolynomialKernel, algebra};
///
/// // Lucy (1977), doi:10.1086/112164: (1 + 3q)(1 − q)³ on [0, 1), σ₂ = 5/π.
/// let piece = algebra::product(&[1.0, 3.0], &algebra::power(&[1.0, -1.0], 3));
/// let shape = PiecewisePolynomial { breaks: vec![0.0, 1.0], pieces: vec![piece] };
/// let lucy = PolynomialKernel::new("lucy", shape);
/// assert!((lucy.normalisation(2) - 5.0 / std::f64::consts::PI).abs() < 1e-15);
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct PolynomialKernel {
    name: &'static str,
    shape: PiecewisePolynomial,
}

impl PolynomialKernel {
    /// A kernel from its shape.
    ///
    /// # Panics
    /// If [`PiecewisePolynomial::check`] refuses the shape.
    pub fn new(name: &'static str, shape: PiecewisePolynomial) -> Self {
        if let Err(reason) = shape.check() {
            panic!("kernel {name}: {reason}");
        }
        Self { name, shape }
    }

    /// The shape f(q).
    pub fn shape(&self) -> &PiecewisePolynomial {
        &self.shape
    }
}

impl Kernel for PolynomialKernel {
    fn name(&self) -> &str {
        self.name
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

/// Below this q the factor f'(q)/q is taken at it: its limit for smooth f, finite for all.
const SMALLEST_Q: f64 = 1e-8;

/// [`Sampler`] of a kernel known by `value` and `derivative` only: general and slow.
///
/// Meant for kernels that are not polynomial, and as the reference of faster ones.
#[derive(Clone, Debug)]
pub struct ScalarSampler<K> {
    kernel: K,
    dimension: usize,
    h: f64,
    radius: f64,
    value_scale: f64,
    factor_scale: f64,
}

impl<K: Kernel> ScalarSampler<K> {
    /// Binds a kernel to a dimension (1, 2, 3) and the smoothing length h in m.
    ///
    /// # Panics
    /// If the dimension is not 1, 2 or 3 or h is not positive.
    pub fn new(kernel: K, dimension: usize, h: f64) -> Self {
        assert_smoothing_length(h);
        let value_scale = kernel.normalisation(dimension) / h.powi(dimension as i32);
        let radius = kernel.support() * h;
        let factor_scale = value_scale / (h * h);
        Self {
            kernel,
            dimension,
            h,
            radius,
            value_scale,
            factor_scale,
        }
    }

    fn at_squared(&self, r2: f64) -> (f64, f64) {
        if r2 >= self.radius * self.radius {
            return (0.0, 0.0);
        }
        let q = r2.sqrt() / self.h;
        let away = if q < SMALLEST_Q { SMALLEST_Q } else { q };
        let (value, factor) = (self.kernel.value(q), self.kernel.derivative(away) / away);
        (self.value_scale * value, self.factor_scale * factor)
    }
}

impl<K: Kernel> Sampler for ScalarSampler<K> {
    fn dimension(&self) -> usize {
        self.dimension
    }
    fn smoothing_length(&self) -> f64 {
        self.h
    }
    fn support_radius(&self) -> f64 {
        self.radius
    }
    fn value_at_zero(&self) -> f64 {
        self.at_squared(0.0).0
    }
    fn at(&self, r: f64) -> (f64, f64) {
        self.at_squared(r * r)
    }
    fn value(&self, r2: &[f64], w: &mut [f64]) {
        assert_eq!(r2.len(), w.len());
        for (w, r2) in w.iter_mut().zip(r2) {
            *w = self.at_squared(*r2).0;
        }
    }
    fn gradient_factor(&self, r2: &[f64], factor: &mut [f64]) {
        assert_eq!(r2.len(), factor.len());
        for (factor, r2) in factor.iter_mut().zip(r2) {
            *factor = self.at_squared(*r2).1;
        }
    }
}

/// Panels of the support; with five points each the error of a smooth f is rounding.
const PANELS: usize = 64;

/// Places and weights of the five-point Gauss–Legendre rule on [−1, 1].
/// Source: Abramowitz & Stegun (1964), table 25.4.
const GAUSS: [[f64; 2]; 5] = [
    [-0.906_179_845_938_664, 0.236_926_885_056_189_08],
    [-0.538_469_310_105_683_1, 0.478_628_670_499_366_47],
    [0.0, 0.568_888_888_888_888_9],
    [0.538_469_310_105_683_1, 0.478_628_670_499_366_47],
    [0.906_179_845_938_664, 0.236_926_885_056_189_08],
];

/// Places and weights of the five-point Gauss–Legendre rule on each of `panels` equal parts of an interval.
pub fn gauss_points(from: f64, to: f64, panels: usize) -> impl Iterator<Item = [f64; 2]> {
    let half = 0.5 * (to - from) / panels as f64;
    (0..panels).flat_map(move |k| {
        let middle = from + (2 * k + 1) as f64 * half;
        GAUSS.map(|[x, w]| [middle + half * x, half * w])
    })
}

/// 1 / (S_d ∫ f q^(d−1) dq) with S_d the surface of the unit sphere.
fn by_gauss(f: impl Fn(f64) -> f64, support: f64, dimension: usize) -> f64 {
    let weight = |q: f64| f(q) * q.powi(dimension as i32 - 1);
    let all = gauss_points(0.0, support, PANELS);
    1.0 / (sphere(dimension) * all.map(|[q, w]| w * weight(q)).sum::<f64>())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::builtin;

    #[test]
    fn agrees_with_the_coefficients() {
        for kernel in builtin() {
            for d in 1..=3 {
                let exact = kernel.normalisation(d);
                let error = by_gauss(|q| kernel.value(q), kernel.support(), d) / exact - 1.0;
                // The breaks of the splines need not be panel ends: their jump in the third
                // derivative costs (support/64)⁴.
                assert!(error.abs() < 1e-6, "{} {d}D: {error:e}", kernel.name());
            }
        }
    }
}
