//! Pieces of f(q) and of f'(q)/q in the form that loses no digits.

use crate::{PiecewisePolynomial, algebra};

/// One piece as (support − q)^`root` · p(s) [/ q], with s = |q − `origin`|.
///
/// Monomials in q cancel almost completely near the support: at q = 2 those of Wendland C6 sum
/// 17 000 to 0. The last piece therefore has its root at the support divided out, an inner
/// one is expanded about its right end, and the first one about 0.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Piece {
    /// Right end of the interval in q.
    pub(crate) until: f64,
    /// Order of the root at the support.
    pub(crate) root: usize,
    /// Where s is 0.
    pub(crate) origin: f64,
    /// Ascending coefficients of p, at least one.
    pub(crate) coefficients: Vec<f64>,
    /// Whether the result is divided by q.
    pub(crate) over_q: bool,
}

/// scale · f(q), in ascending order of the intervals.
pub(crate) fn value(shape: &PiecewisePolynomial, scale: f64) -> Vec<Piece> {
    pieces(shape, scale, |piece| (piece.to_vec(), false))
}

/// scale · f'(q)/q, in ascending order of the intervals.
///
/// A derivative without constant term is divided by q here, on the coefficients.
pub(crate) fn factor(shape: &PiecewisePolynomial, scale: f64) -> Vec<Piece> {
    pieces(shape, scale, |piece| {
        let derivative = algebra::derivative(piece);
        match derivative.split_first() {
            Some((constant, rest)) if *constant == 0.0 => (rest.to_vec(), false),
            _ => (derivative, true),
        }
    })
}

fn pieces(
    shape: &PiecewisePolynomial,
    scale: f64,
    polynomial: impl Fn(&[f64]) -> (Vec<f64>, bool),
) -> Vec<Piece> {
    let last = shape.pieces.len() - 1;
    let piece = |k: usize| {
        let (full, over_q) = polynomial(&shape.pieces[k]);
        let until = shape.breaks[k + 1];
        let (root, origin, full) = if k == last {
            let (root, quotient) = divided(full, until);
            (root, 0.0, quotient)
        } else if k == 0 {
            (0, 0.0, full)
        } else {
            (0, until, algebra::reflected(&full, until))
        };
        let mut coefficients = algebra::scaled(&full, scale);
        while coefficients.len() > 1 && coefficients.last() == Some(&0.0) {
            coefficients.pop();
        }
        if coefficients.is_empty() {
            coefficients.push(0.0);
        }
        Piece { until, root, origin, coefficients, over_q }
    };
    (0..=last).map(piece).collect()
}

/// The order n of the root of a(q) at b, and a(q) / (b − q)ⁿ.
///
/// The division starts at the constant term, which is stable because b is the root of largest
/// modulus of a kernel that is positive inside its support.
fn divided(mut a: Vec<f64>, b: f64) -> (usize, Vec<f64>) {
    let mut root = 0;
    while a.len() > 1 {
        let size = a.iter().rev().fold(0.0, |sum, a| sum * b + a.abs());
        // Coefficients are correct to an ulp each: less than that at b is no value.
        if algebra::value(&a, b).abs() > 8.0 * f64::EPSILON * size {
            break;
        }
        let mut before = 0.0;
        for a in &mut a {
            before = (*a + before) / b;
            *a = before;
        }
        a.pop();
        root += 1;
    }
    (root, a)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{cubic_spline, quintic_spline, wendland_c2, wendland_c4, wendland_c6};

    #[test]
    fn wendland_functions_come_back_as_products() {
        // (1 − q/2)⁴ (1 + 2q) = (2 − q)⁴ (1 + 2q)/16 and f'/q = −5/8 (2 − q)³
        let f = &value(wendland_c2().shape(), 16.0)[0];
        assert_eq!((f.root, f.coefficients.as_slice()), (4, &[1.0, 2.0][..]));
        let g = &factor(wendland_c2().shape(), 8.0)[0];
        assert_eq!((g.root, g.coefficients.as_slice(), g.over_q), (3, &[-5.0][..], false));
        let f = &value(wendland_c6().shape(), 256.0)[0];
        assert_eq!((f.root, f.coefficients.as_slice()), (8, &[1.0, 4.0, 6.25, 4.0][..]));
        let f = &value(wendland_c4().shape(), 64.0)[0];
        assert_eq!((f.root, f.coefficients.len()), (6, 3));
        let error = f.coefficients[2] - 35.0 / 12.0;
        assert!(error.abs() < 1e-15, "35/12 comes back to {error:e}");
    }

    #[test]
    fn splines_end_in_one_power() {
        let f = value(quintic_spline().shape(), 1.0);
        assert_eq!((f[2].root, f[2].coefficients.as_slice()), (5, &[1.0][..]));
        assert_eq!((f[1].root, f[1].origin), (0, 2.0));
        let g = factor(cubic_spline().shape(), 1.0);
        assert_eq!((g[0].coefficients.as_slice(), g[0].over_q), (&[-3.0, 2.25][..], false));
        assert_eq!((g[1].root, g[1].coefficients.as_slice(), g[1].over_q), (2, &[-0.75][..], true));
    }

    #[test]
    fn a_constant_has_no_derivative() {
        let shape = PiecewisePolynomial { breaks: vec![0.0, 1.0], pieces: vec![vec![1.0]] };
        assert_eq!(factor(&shape, 1.0)[0].coefficients, [0.0]);
        assert_eq!(value(&shape, 1.0)[0].root, 0);
    }
}
