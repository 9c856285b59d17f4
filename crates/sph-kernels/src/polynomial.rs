//! The shape of a kernel as a piecewise polynomial in q = r/h.

use crate::algebra;

/// f(q) on consecutive intervals of q = r/h, zero beyond the last break.
///
/// Interval `k` is `[breaks[k], breaks[k + 1])` with `breaks[0] = 0`; its polynomial is `Σ_n pieces[k][n] qⁿ` in the
/// global variable q (not in the distance from the break). The shape is not normalised: w(r) = σ_d / h^d · f(r/h).
///
/// ```
/// use sph_kernels::PiecewisePolynomial;
///
/// // The hat 1 − q on [0, 1): area 1/2 on the half axis, hence σ₁ = 1.
/// let hat = PiecewisePolynomial { breaks: vec![0.0, 1.0], pieces: vec![vec![1.0, -1.0]] };
/// assert_eq!((hat.value(0.25), hat.derivative(0.25)), (0.75, -1.0));
/// assert_eq!((hat.moment(0), hat.normalisation(1)), (0.5, 1.0));
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct PiecewisePolynomial {
    /// Ascending breaks in q; the last one is the support radius over h.
    pub breaks: Vec<f64>,
    /// Ascending coefficients of every interval.
    pub pieces: Vec<Vec<f64>>,
}

impl PiecewisePolynomial {
    /// Support radius over h.
    pub fn support(&self) -> f64 {
        self.breaks.last().copied().unwrap_or(0.0)
    }

    /// f(q) for q ≥ 0, by Horner's rule in q.
    ///
    /// Rounding is of the order of ε Σ|c_n| qⁿ: up to 10⁻¹³ f(0) near the support of the
    /// built-in kernels. A [`Sampler`](crate::Sampler) evaluates factored forms and does better.
    pub fn value(&self, q: f64) -> f64 {
        self.piece(q).map_or(0.0, |piece| algebra::value(piece, q))
    }

    /// f'(q) for q ≥ 0; from the right at a break.
    pub fn derivative(&self, q: f64) -> f64 {
        let Some(piece) = self.piece(q) else {
            return 0.0;
        };
        let terms = (1..piece.len()).rev();
        terms.fold(0.0, |sum, n| sum * q + n as f64 * piece[n])
    }

    /// `Ok` if breaks and pieces fit the definition of the type, else the fault.
    pub fn check(&self) -> Result<(), String> {
        let (breaks, pieces) = (&self.breaks, &self.pieces);
        if pieces.is_empty() || breaks.len() != pieces.len() + 1 {
            let (pieces, breaks) = (pieces.len(), breaks.len());
            return Err(format!(
                "{pieces} pieces need one break more than that, and there are {breaks}"
            ));
        }
        if breaks[0] != 0.0 {
            return Err(format!("the first break is {} and must be 0", breaks[0]));
        }
        if !breaks.is_sorted_by(|a, b| a < b) || !self.support().is_finite() {
            return Err(format!(
                "the breaks {breaks:?} do not ascend to a finite support"
            ));
        }
        if !pieces.iter().flatten().all(|c| c.is_finite()) {
            return Err("a coefficient is not finite".into());
        }
        Ok(())
    }

    /// Coefficients of the interval that holds q, if any.
    fn piece(&self, q: f64) -> Option<&[f64]> {
        let after = self.breaks.iter().position(|b| q < *b)?;
        self.pieces.get(after.checked_sub(1)?).map(Vec::as_slice)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn two_pieces() -> PiecewisePolynomial {
        PiecewisePolynomial {
            breaks: vec![0.0, 1.0, 2.0],
            pieces: vec![vec![2.0, 0.0, -1.0], vec![4.0, -4.0, 1.0]],
        }
    }

    #[test]
    fn an_interval_holds_its_lower_break() {
        let f = two_pieces();
        assert_eq!((f.value(0.0), f.derivative(0.0)), (2.0, 0.0));
        assert_eq!((f.value(1.0), f.derivative(1.0)), (1.0, -2.0));
        assert_eq!((f.value(2.0), f.derivative(2.0)), (0.0, 0.0));
        assert_eq!((f.value(9.0), f.value(-1.0)), (0.0, 0.0));
    }

    #[test]
    fn malformed_shapes_are_named() {
        assert_eq!(two_pieces().check(), Ok(()));
        let broken = |change: fn(&mut PiecewisePolynomial)| {
            let mut f = two_pieces();
            change(&mut f);
            f.check().unwrap_err()
        };
        assert!(broken(|f| f.breaks[0] = 0.5).contains("must be 0"));
        assert!(broken(|f| f.breaks[1] = 3.0).contains("ascend"));
        assert!(broken(|f| f.breaks.truncate(2)).contains("one break more"));
        assert!(broken(|f| f.pieces[1][0] = f64::NAN).contains("not finite"));
    }
}
