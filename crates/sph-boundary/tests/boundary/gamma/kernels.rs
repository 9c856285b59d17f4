//! The kernels written as products, which do not cancel near the support.

use sph_kernels::PiecewisePolynomial;
use sph_kernels::algebra::{power, scaled, sum};

/// A kernel twice: the coefficients under test and an independent value of f(q).
pub struct TestKernel {
    pub name: &'static str,
    pub shape: PiecewisePolynomial,
    pub value: fn(f64) -> f64,
    /// σ₂ as published.
    pub sigma: f64,
}

pub fn all() -> Vec<TestKernel> {
    use std::f64::consts::PI;
    let shape = |kernel: sph_kernels::PolynomialKernel| kernel.shape().clone();
    vec![
        TestKernel {
            name: "wendland-c2",
            shape: shape(sph_kernels::wendland_c2()),
            value: |q| (1.0 - 0.5 * q).max(0.0).powi(4) * (1.0 + 2.0 * q),
            sigma: 7.0 / (4.0 * PI),
        },
        TestKernel {
            name: "wendland-c4",
            shape: shape(sph_kernels::wendland_c4()),
            value: |q| (1.0 - 0.5 * q).max(0.0).powi(6) * (1.0 + 3.0 * q + 35.0 / 12.0 * q * q),
            sigma: 9.0 / (4.0 * PI),
        },
        TestKernel {
            name: "wendland-c6",
            shape: shape(sph_kernels::wendland_c6()),
            value: |q| (1.0 - 0.5 * q).max(0.0).powi(8) * (1.0 + q * (4.0 + q * (6.25 + 4.0 * q))),
            sigma: 39.0 / (14.0 * PI),
        },
        TestKernel {
            name: "cubic",
            shape: shape(sph_kernels::cubic_spline()),
            value: |q| 0.25 * (2.0 - q).max(0.0).powi(3) - (1.0 - q).max(0.0).powi(3),
            sigma: 10.0 / (7.0 * PI),
        },
        TestKernel {
            name: "quartic",
            shape: shape(sph_kernels::quartic_spline()),
            value: |q| {
                (2.5 - q).max(0.0).powi(4) - 5.0 * (1.5 - q).max(0.0).powi(4)
                    + 10.0 * (0.5 - q).max(0.0).powi(4)
            },
            sigma: 96.0 / (1199.0 * PI),
        },
        TestKernel {
            name: "quintic",
            shape: shape(sph_kernels::quintic_spline()),
            value: |q| {
                (3.0 - q).max(0.0).powi(5) - 6.0 * (2.0 - q).max(0.0).powi(5)
                    + 15.0 * (1.0 - q).max(0.0).powi(5)
            },
            sigma: 7.0 / (478.0 * PI),
        },
        TestKernel {
            name: "septic",
            shape: septic(),
            value: |q| {
                (4.0 - q).max(0.0).powi(7) - 8.0 * (3.0 - q).max(0.0).powi(7)
                    + 28.0 * (2.0 - q).max(0.0).powi(7)
                    - 56.0 * (1.0 - q).max(0.0).powi(7)
            },
            sigma: 9.0 / (29740.0 * PI),
        },
        TestKernel {
            name: "degree 14",
            shape: PiecewisePolynomial {
                breaks: vec![0.0, 2.0],
                pieces: vec![power(&[1.0, -0.5], 14)],
            },
            value: |q| (1.0 - 0.5 * q).max(0.0).powi(14),
            sigma: 30.0 / PI,
        },
    ]
}

/// Spline of degree 7, support 4h: a stranger's kernel with several pieces and large coefficients.
fn septic() -> PiecewisePolynomial {
    let term = |edge: f64, weight: f64| scaled(&power(&[edge, -1.0], 7), weight);
    let mut pieces = vec![term(4.0, 1.0)];
    for (edge, weight) in [(3.0, -8.0), (2.0, 28.0), (1.0, -56.0)] {
        pieces.insert(0, sum(&pieces[0], &term(edge, weight)));
    }
    PiecewisePolynomial {
        breaks: vec![0.0, 1.0, 2.0, 3.0, 4.0],
        pieces,
    }
}
