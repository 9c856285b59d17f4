//! Sums and products in twice the precision of f64, for set-up work.

/// The unevaluated sum of two numbers, of which the second is at most half an ulp of the first.
///
/// Moments of high-order kernels cancel twelve of sixteen digits between the monomials; with 32 digits their sums are
/// exact to the last bit of the result.
/// Source: Dekker (1971), Numerische Mathematik 18, doi:10.1007/BF01397083.
#[derive(Clone, Copy, Debug)]
pub(crate) struct DoubleDouble(f64, f64);

impl DoubleDouble {
    pub(crate) const ZERO: Self = Self(0.0, 0.0);
    pub(crate) const ONE: Self = Self(1.0, 0.0);

    /// Nearest f64.
    pub(crate) fn value(self) -> f64 {
        self.0 + self.1
    }

    pub(crate) fn plus(self, other: Self) -> Self {
        let (high, low) = two_sum(self.0, other.0);
        normalised(high, low + self.1 + other.1)
    }

    pub(crate) fn minus(self, other: Self) -> Self {
        self.plus(Self(-other.0, -other.1))
    }

    pub(crate) fn times(self, b: f64) -> Self {
        let (high, low) = two_product(self.0, b);
        normalised(high, low + self.1 * b)
    }

    pub(crate) fn over(self, b: f64) -> Self {
        let quotient = self.0 / b;
        let (high, low) = two_product(quotient, b);
        let rest = (self.0 - high) - low + self.1;
        normalised(quotient, rest / b)
    }

    /// xⁿ; negative n by division.
    pub(crate) fn power(x: f64, n: i32) -> Self {
        let step = if n < 0 { Self::over } else { Self::times };
        (0..n.unsigned_abs()).fold(Self::ONE, |result, _| step(result, x))
    }
}

fn two_sum(a: f64, b: f64) -> (f64, f64) {
    let high = a + b;
    let b_part = high - a;
    (high, (a - (high - b_part)) + (b - b_part))
}

/// As [`two_sum`] for |a| ≥ |b|.
fn normalised(a: f64, b: f64) -> DoubleDouble {
    let high = a + b;
    DoubleDouble(high, b - (high - a))
}

fn two_product(a: f64, b: f64) -> (f64, f64) {
    let split = |x: f64| {
        let c = 134_217_729.0 * x; // 2²⁷ + 1
        let high = c - (c - x);
        (high, x - high)
    };
    let ((a1, a2), (b1, b2)) = (split(a), split(b));
    let high = a * b;
    (high, ((a1 * b1 - high) + a1 * b2 + a2 * b1) + a2 * b2)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_cancelling_sum_keeps_its_small_part() {
        // (1 + 2⁻⁴⁰)² − 1 − 2⁻³⁹ = 2⁻⁸⁰, lost in plain f64.
        let x = 1.0 + 2f64.powi(-40);
        let rest = DoubleDouble::power(x, 2).minus(DoubleDouble::ONE);
        let rest = rest.minus(DoubleDouble::ONE.times(2f64.powi(-39)));
        assert_eq!(rest.value(), 2f64.powi(-80));
    }

    #[test]
    fn thirds_come_back() {
        let third = DoubleDouble::ONE.over(3.0);
        let rest = third.plus(third).plus(third).minus(DoubleDouble::ONE);
        let rest = rest.value();
        assert!(rest.abs() < 1e-31, "1/3 + 1/3 + 1/3 − 1 = {rest:e}");
        assert_eq!(DoubleDouble::power(2.0, -3).value(), 0.125);
        assert_eq!(DoubleDouble::ZERO.value(), 0.0);
    }
}
