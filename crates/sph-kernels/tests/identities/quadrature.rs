//! Composite Gauss-Legendre quadrature, independent of the crate.

use std::f64::consts::PI;

use sph_kernels::{Kernel, PolynomialKernel};

const ORDER: usize = 20;

/// Abscissae and weights on [−1, 1] by Newton's method on the Legendre polynomial.
fn gauss() -> [(f64, f64); ORDER] {
    std::array::from_fn(|k| {
        let n = ORDER as f64;
        let mut x = (PI * (k as f64 + 0.75) / (n + 0.5)).cos();
        let mut slope = 0.0;
        for _ in 0..20 {
            let (mut before, mut here) = (1.0, x);
            for j in 2..=ORDER {
                let j = j as f64;
                (before, here) = (here, ((2.0 * j - 1.0) * x * here - (j - 1.0) * before) / j);
            }
            slope = n * (x * here - before) / (x * x - 1.0);
            x -= here / slope;
        }
        (x, 2.0 / ((1.0 - x * x) * slope * slope))
    })
}

/// ∫ w(q) g(q) dq over the support, w in d dimensions with h = 1 m, `panels` panels per piece.
pub fn integral(kernel: &PolynomialKernel, d: usize, panels: usize, g: impl Fn(f64) -> f64) -> f64 {
    let (nodes, sampler) = (gauss(), kernel.sampler(d, 1.0));
    let mut sum = 0.0;
    for bounds in kernel.shape().breaks.windows(2) {
        let half = 0.5 * (bounds[1] - bounds[0]) / panels as f64;
        for panel in 0..panels {
            let middle = bounds[0] + (2 * panel + 1) as f64 * half;
            for (x, weight) in nodes {
                let q = middle + half * x;
                sum += half * weight * sampler.at(q).0 * g(q);
            }
        }
    }
    sum
}

/// Surface of the unit sphere in d dimensions.
pub fn sphere(d: usize) -> f64 {
    [2.0, 2.0 * PI, 4.0 * PI][d - 1]
}
