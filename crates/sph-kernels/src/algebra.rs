//! Products, powers and shifts of polynomials given by ascending coefficients.

use crate::double_double::DoubleDouble;

/// Coefficients of the product a(q) b(q).
///
/// ```
/// use sph_kernels::algebra::product;
/// assert_eq!(product(&[1.0, -1.0], &[1.0, 1.0]), [1.0, 0.0, -1.0]);
/// ```
pub fn product(a: &[f64], b: &[f64]) -> Vec<f64> {
    let mut result = vec![0.0; (a.len() + b.len()).saturating_sub(1)];
    for (i, a) in a.iter().enumerate() {
        for (j, b) in b.iter().enumerate() {
            result[i + j] += a * b;
        }
    }
    result
}

/// Coefficients of a(q)ⁿ; n = 0 gives 1.
pub fn power(a: &[f64], n: usize) -> Vec<f64> {
    (0..n).fold(vec![1.0], |result, _| product(&result, a))
}

/// Coefficients of the sum a(q) + b(q).
pub fn sum(a: &[f64], b: &[f64]) -> Vec<f64> {
    let at = |c: &[f64], n: usize| c.get(n).copied().unwrap_or(0.0);
    let terms = 0..a.len().max(b.len());
    terms.map(|n| at(a, n) + at(b, n)).collect()
}

/// Coefficients of c · a(q).
pub fn scaled(a: &[f64], c: f64) -> Vec<f64> {
    a.iter().map(|a| c * a).collect()
}

/// Coefficients of a'(q).
pub fn derivative(a: &[f64]) -> Vec<f64> {
    let terms = (1..).zip(&a[1.min(a.len())..]);
    terms.map(|(n, a)| f64::from(n) * a).collect()
}

/// Coefficients in s of a(q) with q = origin − s: s is the distance left of the origin.
pub fn reflected(a: &[f64], origin: f64) -> Vec<f64> {
    // Horner's rule with the polynomial (origin − s) as its argument.
    a.iter().rev().fold(Vec::new(), |result, &a| {
        sum(&product(&result, &[origin, -1.0]), &[a])
    })
}

/// Coefficients of a(q) in powers of q − centre.
///
/// By repeated Horner division in twice the precision of f64: the monomials may cancel by thirty digits.
pub fn expanded_about(a: &[f64], centre: f64) -> Vec<f64> {
    let mut c: Vec<_> = a.iter().map(|c| DoubleDouble::ONE.times(*c)).collect();
    for first in 0..c.len() {
        for n in (first..c.len() - 1).rev() {
            c[n] = c[n].plus(c[n + 1].times(centre));
        }
    }
    c.into_iter().map(DoubleDouble::value).collect()
}

/// a(q) by Horner's rule.
pub fn value(a: &[f64], q: f64) -> f64 {
    a.iter().rev().fold(0.0, |sum, a| sum * q + a)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn wendland_c2_expands_to_the_published_coefficients() {
        let f = product(&power(&[1.0, -0.5], 4), &[1.0, 2.0]);
        assert_eq!(f, [1.0, 0.0, -2.5, 2.5, -15.0 / 16.0, 0.125]);
        assert_eq!(derivative(&f), [0.0, -5.0, 7.5, -3.75, 0.625]);
    }

    #[test]
    fn reflection_keeps_the_function() {
        let a = [3.0, -1.0, 0.5, 0.25];
        let b = reflected(&a, 1.5);
        for q in [0.0, 0.25, 1.0, 1.5] {
            assert_eq!(value(&a, q), value(&b, 1.5 - q));
        }
    }

    #[test]
    fn a_root_of_high_order_is_found_exactly() {
        // (q − 3)⁶ about 3.
        let monomials = [729.0, -1458.0, 1215.0, -540.0, 135.0, -18.0, 1.0];
        let at_root = expanded_about(&monomials, 3.0);
        assert_eq!(at_root, [0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0]);
        // About 0.1, where nothing is representable: the value and the first slope.
        let shifted = expanded_about(&monomials, 0.1);
        assert!((shifted[0] / 2.9f64.powi(6) - 1.0).abs() < 1e-15);
        assert!((shifted[1] / (-6.0 * 2.9f64.powi(5)) - 1.0).abs() < 1e-15);
        assert!(expanded_about(&[], 1.0).is_empty());
    }

    #[test]
    fn empty_polynomials_are_zero() {
        assert!(derivative(&[]).is_empty() && derivative(&[2.0]).is_empty());
        assert!(product(&[], &[1.0, 2.0]).iter().all(|c| *c == 0.0));
        assert_eq!(value(&[], 1.0), 0.0);
        assert_eq!(power(&[1.0, 1.0], 0), [1.0]);
    }
}
