//! The Wendland functions of minimal degree, support 2h.

use crate::PiecewisePolynomial;
use crate::algebra::{power, product};

/// (1 − q/2)ⁿ times a polynomial on [0, 2).
pub fn wendland(n: usize, factor: &[f64]) -> PiecewisePolynomial {
    PiecewisePolynomial {
        breaks: vec![0.0, 2.0],
        pieces: vec![product(&power(&[1.0, -0.5], n), factor)],
    }
}
