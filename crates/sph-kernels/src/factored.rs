//! Pieces of f(q) and of f'(q)/q in the form that loses no digits.

use crate::{PiecewisePolynomial, algebra};

/// One piece as (support − q)^`root` · p(s) with s = |q − `origin`|.
///
/// Monomials in q cancel almost completely near the support: at q = 2 those of Wendland C6 sum
/// 17 000 to 0. A single piece therefore has its root at the support divided out; of several
/// ones the first is expanded about 0 and the others about their right ends.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Piece {
    /// Right end of the interval in q.
    pub(crate) until: f64,
    /// Order of the root at the support.
    pub(crate) root: usize,
    /// Zero of s.
    pub(crate) origin: f64,
    /// Ascending coefficients of p, at least one.
    pub(crate) coefficients: Vec<f64>,
}

/// Pieces in ascending order, their value to be divided by q where q ≥ `divided_from`.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Pieces {
    pub(crate) list: Vec<Piece>,
    pub(crate) divided_from: f64,
}

/// scale · f(q).
pub(crate) fn value(shape: &PiecewisePolynomial, scale: f64) -> Pieces {
    Pieces {
        list: factored(shape, &shape.pieces, scale),
        divided_from: f64::INFINITY,
    }
}

/// scale · f'(q)/q.
///
/// The first piece is divided by q on its coefficients unless f'(0) ≠ 0, the others have a
/// constant term in f' and are divided by the number q.
pub(crate) fn factor(shape: &PiecewisePolynomial, scale: f64) -> Pieces {
    let derivatives = shape.pieces.iter().map(|piece| algebra::derivative(piece));
    let mut derivatives: Vec<_> = derivatives.collect();
    let divided_from = match derivatives[0].first() {
        Some(cusp) if *cusp != 0.0 => 0.0,
        Some(_) => {
            derivatives[0].remove(0);
            shape.breaks[1]
        }
        None => shape.breaks[1],
    };
    Pieces {
        list: factored(shape, &derivatives, scale),
        divided_from,
    }
}

fn factored(shape: &PiecewisePolynomial, polynomials: &[Vec<f64>], scale: f64) -> Vec<Piece> {
    let last = polynomials.len() - 1;
    let piece = |(k, polynomial): (usize, &Vec<f64>)| {
        let until = shape.breaks[k + 1];
        let (root, quotient) = match k == last {
            true => divided(polynomial.clone(), until),
            false => (0, polynomial.clone()),
        };
        let (root, origin, p) = if k == 0 {
            (root, 0.0, quotient)
        } else {
            // sⁿ p(s): the root becomes n leading zeros.
            let p = [vec![0.0; root], algebra::reflected(&quotient, until)].concat();
            (0, until, p)
        };
        let mut coefficients = algebra::scaled(&p, scale);
        while coefficients.last() == Some(&0.0) {
            coefficients.pop();
        }
        if coefficients.is_empty() {
            coefficients.push(0.0);
        }
        Piece {
            until,
            root,
            origin,
            coefficients,
        }
    };
    polynomials.iter().enumerate().map(piece).collect()
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
        for (pieces, root, coefficients) in [
            (value(wendland_c2().shape(), 16.0), 4, &[1.0, 2.0][..]),
            (factor(wendland_c2().shape(), 8.0), 3, &[-5.0]),
            (
                value(wendland_c6().shape(), 256.0),
                8,
                &[1.0, 4.0, 6.25, 4.0],
            ),
        ] {
            let piece = &pieces.list[0];
            assert_eq!((piece.root, &piece.coefficients[..]), (root, coefficients));
        }
        let f = &value(wendland_c4().shape(), 64.0).list[0];
        assert_eq!((f.root, f.coefficients.len()), (6, 3));
        let error = f.coefficients[2] - 35.0 / 12.0;
        assert!(error.abs() < 2e-15, "35/12 comes back to {error:e}");
        let g = &factor(wendland_c4().shape(), 1.0).list[0];
        assert_eq!((g.root, g.coefficients.len()), (5, 2));
    }

    #[test]
    fn splines_end_in_one_power() {
        let f = value(quintic_spline().shape(), 1.0);
        assert_eq!(f.list[2].coefficients, [0.0, 0.0, 0.0, 0.0, 0.0, 1.0]);
        let origins: Vec<f64> = f.list.iter().map(|piece| piece.origin).collect();
        assert_eq!(origins, [0.0, 2.0, 3.0]);
        let g = factor(cubic_spline().shape(), 1.0);
        assert_eq!(g.list[0].coefficients, [-3.0, 2.25]);
        assert_eq!(g.list[1].coefficients, [0.0, 0.0, -0.75]);
        assert_eq!(g.divided_from, 1.0);
    }

    #[test]
    fn cusps_and_constants() {
        let shape = |piece| PiecewisePolynomial {
            breaks: vec![0.0, 1.0],
            pieces: vec![piece],
        };
        let hat = factor(&shape(vec![1.0, -1.0]), 1.0);
        assert_eq!(hat.divided_from, 0.0);
        assert_eq!(hat.list[0].coefficients, [-1.0]);
        let constant = shape(vec![1.0]);
        assert_eq!(factor(&constant, 1.0).list[0].coefficients, [0.0]);
        assert_eq!(value(&constant, 1.0).list[0].root, 0);
    }
}
