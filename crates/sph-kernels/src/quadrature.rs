//! Normalisation of a shape known only by its values.

use crate::moments::sphere;

/// Panels of the support; with five points each the error of a smooth f is rounding.
const PANELS: usize = 64;

/// Abscissae and weights of the five-point Gauss-Legendre rule on [−1, 1], right half.
/// Source: Abramowitz & Stegun (1964), table 25.4.
const GAUSS: [(f64, f64); 3] = [
    (0.0, 0.568_888_888_888_888_9),
    (0.538_469_310_105_683_1, 0.478_628_670_499_366_47),
    (0.906_179_845_938_664, 0.236_926_885_056_189_08),
];

/// 1 / (S_d ∫ f q^(d−1) dq) with S_d the surface of the unit sphere.
pub(crate) fn normalisation(f: impl Fn(f64) -> f64, support: f64, dimension: usize) -> f64 {
    let weight = |q: f64| f(q) * q.powi(dimension as i32 - 1);
    let half = 0.5 * support / PANELS as f64;
    let panel = |k: usize| {
        let middle = (2 * k + 1) as f64 * half;
        let pairs = GAUSS[1..]
            .iter()
            .map(|(x, w)| w * (weight(middle - half * x) + weight(middle + half * x)));
        half * (GAUSS[0].1 * weight(middle) + pairs.sum::<f64>())
    };
    1.0 / (sphere(dimension) * (0..PANELS).map(panel).sum::<f64>())
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
