//! Integrals by points of Gauss: the normalisation of a shape known only by its values.

use crate::moments::sphere;

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
pub(crate) fn normalisation(f: impl Fn(f64) -> f64, support: f64, dimension: usize) -> f64 {
    let weight = |q: f64| f(q) * q.powi(dimension as i32 - 1);
    let all = gauss_points(0.0, support, PANELS);
    1.0 / (sphere(dimension) * all.map(|[q, w]| w * weight(q)).sum::<f64>())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Kernel, builtin};

    #[test]
    fn agrees_with_the_coefficients() {
        for kernel in builtin() {
            for d in 1..=3 {
                let exact = kernel.normalisation(d);
                let error = normalisation(|q| kernel.value(q), kernel.support(), d) / exact - 1.0;
                // The breaks of the splines need not be panel ends: their jump in the third
                // derivative costs (support/64)⁴.
                assert!(error.abs() < 1e-6, "{} {d}D: {error:e}", kernel.name());
            }
        }
    }
}
