//! Sums and products in twice the precision of f64, for set-up work.

/// The unevaluated sum `high + low` with |low| ≤ ulp(high)/2.
///
/// Moments of high-order kernels cancel twelve of sixteen digits between the monomials; with
/// 32 digits their sums are exact to the last bit of the result.
/// Source: Dekker (1971), Numerische Mathematik 18, doi:10.1007/BF01397083.
#[derive(Clone, Copy, Debug)]
pub(crate) struct DoubleDouble {
    high: f64,
    low: f64,
}

impl DoubleDouble {
    pub(crate) const ZERO: Self = Self {
        high: 0.0,
        low: 0.0,
    };
    pub(crate) const ONE: Self = Self {
        high: 1.0,
        low: 0.0,
    };

    /// Nearest f64.
    pub(crate) fn value(self) -> f64 {
        self.high + self.low
    }

    pub(crate) fn plus(self, other: Self) -> Self {
        let sum = two_sum(self.high, other.high);
        normalised(sum.high, sum.low + self.low + other.low)
    }

    pub(crate) fn minus(self, other: Self) -> Self {
        self.plus(Self {
            high: -other.high,
            low: -other.low,
        })
    }

    pub(crate) fn times(self, b: f64) -> Self {
        let product = two_product(self.high, b);
        normalised(product.high, product.low + self.low * b)
    }

    pub(crate) fn over(self, b: f64) -> Self {
        let quotient = self.high / b;
        let back = two_product(quotient, b);
        let rest = (self.high - back.high) - back.low + self.low;
        normalised(quotient, rest / b)
    }

    /// xⁿ; negative n by division.
    pub(crate) fn power(x: f64, n: i32) -> Self {
        let step = |result: Self| {
            if n < 0 {
                result.over(x)
            } else {
                result.times(x)
            }
        };
        (0..n.unsigned_abs()).fold(Self::ONE, |result, _| step(result))
    }
}

fn two_sum(a: f64, b: f64) -> DoubleDouble {
    let high = a + b;
    let b_part = high - a;
    DoubleDouble {
        high,
        low: (a - (high - b_part)) + (b - b_part),
    }
}

/// As [`two_sum`] for |a| ≥ |b|.
fn normalised(a: f64, b: f64) -> DoubleDouble {
    let high = a + b;
    DoubleDouble {
        high,
        low: b - (high - a),
    }
}

fn two_product(a: f64, b: f64) -> DoubleDouble {
    let split = |x: f64| {
        let c = 134_217_729.0 * x; // 2²⁷ + 1
        let high = c - (c - x);
        (high, x - high)
    };
    let ((a1, a2), (b1, b2)) = (split(a), split(b));
    let high = a * b;
    DoubleDouble {
        high,
        low: ((a1 * b1 - high) + a1 * b2 + a2 * b1) + a2 * b2,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_cancelling_sum_keeps_its_small_part() {
        // (1 + 2⁻⁴⁰)² − 1 − 2⁻³⁹ = 2⁻⁸⁰, lost in plain f64.
        let x = 1.0 + 2f64.powi(-40);
        let rest = DoubleDouble::power(x, 2)
            .minus(DoubleDouble::ONE)
            .minus(DoubleDouble::ONE.times(2f64.powi(-39)));
        assert_eq!(rest.value(), 2f64.powi(-80));
    }

    #[test]
    fn thirds_come_back() {
        let third = DoubleDouble::ONE.over(3.0);
        let rest = third.plus(third).plus(third).minus(DoubleDouble::ONE);
        assert!(
            rest.value().abs() < 1e-31,
            "1/3 + 1/3 + 1/3 − 1 = {:e}",
            rest.value()
        );
        assert_eq!(DoubleDouble::power(2.0, -3).value(), 0.125);
        assert_eq!(DoubleDouble::ZERO.value(), 0.0);
    }
}
