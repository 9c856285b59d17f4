//! Expansion of a polynomial about a point, exact to the last digit.

/// A number as the unevaluated sum of two.
type Pair = [f64; 2];

/// Coefficients of Σ c_n qⁿ in powers of q − `centre`.
///
/// By repeated Horner division in twice the precision of f64: the monomials may cancel by thirty
/// digits. Source: Dekker (1971), Numerische Mathematik 18, doi:10.1007/BF01397083.
pub(super) fn expand_about(coefficients: &[f64], centre: f64) -> Vec<f64> {
    let mut c: Vec<Pair> = coefficients.iter().map(|c| [*c, 0.0]).collect();
    for first in 0..c.len() {
        for n in (first..c.len() - 1).rev() {
            c[n] = plus(c[n], times(c[n + 1], centre));
        }
    }
    c.iter().map(|[high, low]| high + low).collect()
}

fn plus(a: Pair, b: Pair) -> Pair {
    let high = a[0] + b[0];
    let part = high - a[0];
    let rest = (a[0] - (high - part)) + (b[0] - part);
    normalised(high, rest + a[1] + b[1])
}

fn times(a: Pair, b: f64) -> Pair {
    let high = a[0] * b;
    normalised(high, a[0].mul_add(b, -high) + a[1] * b)
}

fn normalised(a: f64, b: f64) -> Pair {
    let high = a + b;
    [high, b - (high - a)]
}

#[test]
fn a_root_of_high_order_is_found_exactly() {
    // (q − 3)⁶ about 3.
    let monomials = [729.0, -1458.0, 1215.0, -540.0, 135.0, -18.0, 1.0];
    assert_eq!(
        expand_about(&monomials, 3.0),
        [0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0]
    );
    // About 0.1, where nothing is representable: the value and the first slope.
    let shifted = expand_about(&monomials, 0.1);
    assert!((shifted[0] / 2.9f64.powi(6) - 1.0).abs() < 1e-15);
    assert!((shifted[1] / (-6.0 * 2.9f64.powi(5)) - 1.0).abs() < 1e-15);
    assert!(expand_about(&[], 1.0).is_empty());
}
