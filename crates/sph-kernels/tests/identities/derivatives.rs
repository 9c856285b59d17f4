//! Gradients against differences and against the derivative of the coefficients.

use sph_kernels::{Kernel, algebra, builtin};

#[test]
fn derivative_is_that_of_the_coefficients() {
    for kernel in builtin() {
        let shape = kernel.shape();
        for (piece, bounds) in shape.pieces.iter().zip(shape.breaks.windows(2)) {
            for k in 0..100 {
                let q = bounds[0] + 0.01 * f64::from(k) * (bounds[1] - bounds[0]);
                let exact = algebra::value(&algebra::derivative(piece), q);
                let error = (kernel.derivative(q) - exact).abs() / kernel.value(0.0);
                assert!(error < 1e-15, "{} at q = {q}: {error:e}", kernel.name());
            }
        }
    }
}

#[test]
fn gradients_agree_with_central_differences() {
    let (h, dr) = (0.3, 2e-5 * 0.3);
    for kernel in builtin() {
        for d in 1..=3 {
            let sampler = kernel.sampler(d, h);
            let mut largest = 0.0_f64;
            for k in 1..400 {
                let r = f64::from(k) / 400.0 * sampler.support_radius();
                let slope = (sampler.at(r + dr).0 - sampler.at(r - dr).0) / (2.0 * dr);
                let error = (sampler.at(r).1 * r - slope) * h / sampler.value_at_zero();
                largest = largest.max(error.abs());
            }
            // Second order: (2·10⁻⁵)² f‴/6 with |f‴| ≤ 20 f(0), and an ulp over 4·10⁻⁵.
            assert!(largest < 2e-9, "{} {d}D: {largest:e} w(0)/h", kernel.name());
        }
    }
}

#[test]
fn factor_at_zero_is_the_curvature() {
    for kernel in builtin() {
        let curvature = 2.0 * kernel.shape().pieces[0][2];
        let h = 0.25;
        let sampler = kernel.sampler(2, h);
        let exact = curvature / kernel.value(0.0) * sampler.value_at_zero() / (h * h);
        let error = sampler.at(0.0).1 / exact - 1.0;
        assert!(
            error.abs() < 1e-15,
            "{}: F(0) off by {error:e}",
            kernel.name()
        );
        // No jump where the first distances lie.
        for r in [1e-300, 1e-160, 1e-12, 1e-9] {
            let change = sampler.at(r).1 / exact - 1.0;
            assert!(
                change.abs() < 1e-8,
                "{}: F({r:e}) off by {change:e}",
                kernel.name()
            );
        }
    }
}
