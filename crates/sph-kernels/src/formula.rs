//! Formulas in q of constant size, so that loops over them become vector instructions.

use std::fmt::Debug;

use crate::factored::{Piece, Pieces};

/// Divisor instead of q = 0 where the first piece has a cusp, f'(0) ≠ 0.
const SMALLEST_Q: f64 = 1e-9;

/// A function of q that is exactly 0 from its support on, without branches on q.
pub(crate) trait Formula: Send + Sync + Debug {
    /// The value at q ≥ 0; NaN stays NaN.
    fn at(&self, q: f64) -> f64;
}

/// (support − q)^ROOT Σ c_n qⁿ with N coefficients.
#[derive(Clone, Debug)]
pub(crate) struct Product<const ROOT: usize, const N: usize> {
    support: f64,
    coefficients: [f64; N],
}

impl<const ROOT: usize, const N: usize> Product<ROOT, N> {
    /// The pieces in this form, if they have it.
    pub(crate) fn from_pieces(pieces: &Pieces) -> Option<Self> {
        let [piece] = pieces.list.as_slice() else {
            return None;
        };
        let whole = piece.root == ROOT && pieces.divided_from >= piece.until;
        let coefficients = piece.coefficients.as_slice().try_into().ok()?;
        whole.then_some(Self {
            support: piece.until,
            coefficients,
        })
    }
}

impl<const ROOT: usize, const N: usize> Formula for Product<ROOT, N> {
    #[inline(always)]
    fn at(&self, q: f64) -> f64 {
        let p = horner(&self.coefficients, q) * power(self.support - q, ROOT);
        if q >= self.support { 0.0 } else { p }
    }
}

/// K pieces of N coefficients each in |q − origin|, all evaluated, one selected.
#[derive(Clone, Debug)]
pub(crate) struct Selection<const K: usize, const N: usize, const DIVIDED: bool> {
    until: [f64; K],
    origin: [f64; K],
    coefficients: [[f64; N]; K],
    divided_from: f64,
}

impl<const K: usize, const N: usize, const DIVIDED: bool> Selection<K, N, DIVIDED> {
    /// The pieces in this form, if they fit.
    pub(crate) fn from_pieces(pieces: &Pieces) -> Option<Self> {
        let list: &[Piece; K] = pieces.list.as_slice().try_into().ok()?;
        let mut each = list.iter();
        let fits = each.all(|piece| piece.root == 0 && piece.coefficients.len() <= N);
        let divided = list.iter().any(|piece| piece.until > pieces.divided_from);
        if !fits || divided != DIVIDED {
            return None;
        }
        let mut coefficients = [[0.0; N]; K];
        for (to, piece) in coefficients.iter_mut().zip(list) {
            to[..piece.coefficients.len()].copy_from_slice(&piece.coefficients);
        }
        Some(Self {
            until: list.each_ref().map(|piece| piece.until),
            origin: list.each_ref().map(|piece| piece.origin),
            coefficients,
            divided_from: pieces.divided_from,
        })
    }
}

impl<const K: usize, const N: usize, const DIVIDED: bool> Formula for Selection<K, N, DIVIDED> {
    #[inline(always)]
    fn at(&self, q: f64) -> f64 {
        let mut result = 0.0;
        for k in (0..K).rev() {
            let p = horner(&self.coefficients[k], (q - self.origin[k]).abs());
            result = if q >= self.until[k] { result } else { p };
        }
        match DIVIDED {
            true => result / divisor(q, self.divided_from),
            false => result,
        }
    }
}

/// Any number of pieces and coefficients: the same arithmetic with loops inside.
#[derive(Clone, Debug)]
pub(crate) struct AnyPieces(pub(crate) Pieces);

impl Formula for AnyPieces {
    fn at(&self, q: f64) -> f64 {
        let Pieces { list, divided_from } = &self.0;
        let Some(piece) = list.iter().find(|piece| q < piece.until || q.is_nan()) else {
            return 0.0;
        };
        let p = horner(&piece.coefficients, (q - piece.origin).abs());
        p * power(piece.until - q, piece.root) / divisor(q, *divided_from)
    }
}

/// q from `from` on and 1 before, never 0.
#[inline(always)]
fn divisor(q: f64, from: f64) -> f64 {
    let away = if q < SMALLEST_Q { SMALLEST_Q } else { q };
    if q < from { 1.0 } else { away }
}

/// Σ c_n sⁿ.
#[inline(always)]
fn horner(c: &[f64], s: f64) -> f64 {
    let last = c.len() - 1;
    let mut sum = c[last];
    for n in (0..last).rev() {
        sum = sum * s + c[n];
    }
    sum
}

/// uⁿ by repeated squaring.
#[inline(always)]
fn power(mut u: f64, mut n: usize) -> f64 {
    let mut result = 1.0;
    while n > 0 {
        if n & 1 == 1 {
            result *= u;
        }
        u *= u;
        n >>= 1;
    }
    result
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{PiecewisePolynomial, factored, quintic_spline, wendland_c6};

    fn assert_close(fast: &dyn Formula, general: &dyn Formula, support: f64) {
        for k in 0..=1000 {
            let q = 0.0011 * f64::from(k) * support;
            let difference = (fast.at(q) - general.at(q)).abs() / general.at(0.0).abs();
            assert!(difference < 2e-16, "{difference:e} at q = {q}");
        }
        assert!(fast.at(f64::NAN).is_nan() && general.at(f64::NAN).is_nan());
        assert!(fast.at(support) == 0.0 && general.at(support) == 0.0);
    }

    #[test]
    fn known_sizes_compute_what_loops_compute() {
        let (wendland, spline) = (wendland_c6(), quintic_spline());
        let f = factored::value(wendland.shape(), 1.0);
        let product = Product::<8, 4>::from_pieces(&f).expect("its form");
        assert_close(&product, &AnyPieces(f), 2.0);
        let g = factored::factor(spline.shape(), 1.0);
        let selection = Selection::<3, 5, true>::from_pieces(&g).expect("its form");
        assert_close(&selection, &AnyPieces(g), 3.0);
    }

    #[test]
    fn other_forms_are_refused() {
        let f = factored::value(wendland_c6().shape(), 1.0);
        assert!(Product::<8, 3>::from_pieces(&f).is_none());
        assert!(Product::<7, 4>::from_pieces(&f).is_none());
        assert!(Selection::<1, 12, false>::from_pieces(&f).is_none());
        let g = factored::factor(quintic_spline().shape(), 1.0);
        assert!(Selection::<3, 5, false>::from_pieces(&g).is_none());
        assert!(Selection::<3, 4, true>::from_pieces(&g).is_none());
    }

    #[test]
    fn a_cusp_stays_finite() {
        let hat = PiecewisePolynomial {
            breaks: vec![0.0, 1.0],
            pieces: vec![vec![1.0, -1.0]],
        };
        let factor = AnyPieces(factored::factor(&hat, 1.0));
        assert_eq!((factor.at(0.0), factor.at(0.5)), (-1.0 / SMALLEST_Q, -2.0));
    }
}
