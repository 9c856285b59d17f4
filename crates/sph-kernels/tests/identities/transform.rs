//! Fourier transforms: positive for Wendland functions, with negative lobes for B-splines.
//!
//! A kernel whose transform turns negative lets particles pair (Dehnen & Aly 2012).

use std::f64::consts::PI;

use sph_kernels::{PolynomialKernel, by_name};

use crate::quadrature::{integral, sphere};

/// J₀(x) = 1/π ∫₀^π cos(x sin θ) dθ; the midpoint rule converges faster than any power.
fn bessel_j0(x: f64) -> f64 {
    let count = 64 + x as usize;
    let angle = |k: usize| (k as f64 + 0.5) * PI / count as f64;
    (0..count).map(|k| (x * angle(k).sin()).cos()).sum::<f64>() / count as f64
}

/// ŵ(k) with ŵ(0) = 1, wave number k in 1/h.
fn transform(kernel: &PolynomialKernel, d: usize, k: f64) -> f64 {
    let sum = match d {
        1 => integral(kernel, d, 8, |q| (k * q).cos()),
        2 => integral(kernel, d, 8, |q| q * bessel_j0(k * q)),
        _ => integral(kernel, d, 8, |q| q * (k * q).sin() / k),
    };
    sphere(d) * sum
}

/// (k, ŵ) of the lowest value for k h from 0.1 to `to`.
fn lowest(kernel: &PolynomialKernel, d: usize, to: f64) -> (f64, f64) {
    let count = (to / 0.1) as usize;
    let values = (1..=count)
        .map(|n| 0.1 * n as f64)
        .map(|k| (k, transform(kernel, d, k)));
    values
        .min_by(|a, b| a.1.total_cmp(&b.1))
        .expect("not empty")
}

#[test]
fn wendland_functions_have_positive_transforms() {
    // ŵ falls as k^−(d+3), k^−(d+5), k^−(d+7); beyond these k it nears the rounding of the
    // quadrature, 10⁻¹⁵.
    for (name, to) in [
        ("wendland-c2", 60.0),
        ("wendland-c4", 40.0),
        ("wendland-c6", 30.0),
    ] {
        let kernel = by_name(name).expect("built in");
        for d in 1..=3 {
            let (k, value) = lowest(&kernel, d, to);
            assert!(value > 1e-13, "{name} {d}D: lowest ŵ {value:e} at kh = {k}");
        }
    }
}

#[test]
fn radial_splines_have_negative_lobes() {
    for name in ["cubic-spline", "quartic-spline", "quintic-spline"] {
        let kernel = by_name(name).expect("built in");
        for d in 2..=3 {
            let (k, value) = lowest(&kernel, d, 20.0);
            assert!(value < -1e-5, "{name} {d}D: lowest ŵ {value:e} at kh = {k}");
        }
    }
}

#[test]
fn splines_on_the_line_are_powers_of_sinc() {
    for (name, n) in [
        ("cubic-spline", 4),
        ("quartic-spline", 5),
        ("quintic-spline", 6),
    ] {
        let kernel = by_name(name).expect("built in");
        for k in [0.5, 2.0, 5.0, 2.0 * PI, 8.9, 15.0] {
            let exact = ((0.5 * k).sin() / (0.5 * k)).powi(n);
            let error = transform(&kernel, 1, k) - exact;
            assert!(error.abs() < 1e-14, "{name} kh = {k}: ŵ off by {error:e}");
        }
    }
}
