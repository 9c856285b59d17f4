//! The sampler of any kernel, one distance at a time.

use crate::sampler::assert_smoothing_length;
use crate::{Kernel, Sampler};

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
