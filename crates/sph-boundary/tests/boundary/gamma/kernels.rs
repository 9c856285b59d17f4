//! The kernels written as products, which do not cancel near the support.

use std::f64::consts::PI;

use sph_kernels::algebra::{power, scaled, sum};
use sph_kernels::{
    PiecewisePolynomial, PolynomialKernel, cubic_spline, quartic_spline, quintic_spline,
    wendland_c2, wendland_c4, wendland_c6,
};

/// A kernel twice: the coefficients under test and an independent value of f(q).
pub struct TestKernel {
    pub name: &'static str,
    pub shape: PiecewisePolynomial,
    pub value: fn(f64) -> f64,
    /// σ₂ as published.
    pub sigma: f64,
}

pub fn all() -> Vec<TestKernel> {
    let built_in = |name, kernel: PolynomialKernel, sigma, value| TestKernel {
        name,
        shape: kernel.shape().clone(),
        sigma,
        value,
    };
    let degree_14 = PiecewisePolynomial {
        breaks: vec![0.0, 2.0],
        pieces: vec![power(&[1.0, -0.5], 14)],
    };
    vec![
        built_in("wendland-c2", wendland_c2(), 7.0 / (4.0 * PI), |q| {
            part(1.0, 0.5 * q, 4) * (1.0 + 2.0 * q)
        }),
        built_in("wendland-c4", wendland_c4(), 9.0 / (4.0 * PI), |q| {
            part(1.0, 0.5 * q, 6) * (1.0 + 3.0 * q + 35.0 / 12.0 * q * q)
        }),
        built_in("wendland-c6", wendland_c6(), 39.0 / (14.0 * PI), |q| {
            part(1.0, 0.5 * q, 8) * (1.0 + q * (4.0 + q * (6.25 + 4.0 * q)))
        }),
        built_in("cubic", cubic_spline(), 10.0 / (7.0 * PI), |q| {
            0.25 * part(2.0, q, 3) - part(1.0, q, 3)
        }),
        built_in("quartic", quartic_spline(), 96.0 / (1199.0 * PI), |q| {
            part(2.5, q, 4) - 5.0 * part(1.5, q, 4) + 10.0 * part(0.5, q, 4)
        }),
        built_in("quintic", quintic_spline(), 7.0 / (478.0 * PI), |q| {
            part(3.0, q, 5) - 6.0 * part(2.0, q, 5) + 15.0 * part(1.0, q, 5)
        }),
        TestKernel {
            name: "septic",
            shape: septic(),
            value: |q| {
                part(4.0, q, 7) - 8.0 * part(3.0, q, 7) + 28.0 * part(2.0, q, 7)
                    - 56.0 * part(1.0, q, 7)
            },
            sigma: 9.0 / (29740.0 * PI),
        },
        TestKernel {
            name: "degree 14",
            shape: degree_14,
            value: |q| part(1.0, 0.5 * q, 14),
            sigma: 30.0 / PI,
        },
    ]
}

/// (edge − q)ⁿ up to the edge.
fn part(edge: f64, q: f64, n: i32) -> f64 {
    (edge - q).max(0.0).powi(n)
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
