//! Integrals of a shape over q, exactly from its coefficients.

use std::f64::consts::PI;

use crate::PiecewisePolynomial;
use crate::double_double::DoubleDouble;

impl PiecewisePolynomial {
    /// ∫ f(q) qⁿ dq from `from` to `to`, the shape being zero outside `[0, support]`.
    ///
    /// Summed in doubled precision and rounded once. For n < 0 the integral from q = 0 exists
    /// only if f vanishes fast enough there; otherwise the result is infinite.
    pub fn integral(&self, n: i32, from: f64, to: f64) -> f64 {
        if from > to {
            return -self.integral(n, to, from);
        }
        let mut sum = DoubleDouble::ZERO;
        let mut logarithms = 0.0;
        for (piece, bounds) in self.pieces.iter().zip(self.breaks.windows(2)) {
            let (a, b) = (bounds[0].max(from), bounds[1].min(to));
            if a >= b {
                continue;
            }
            for (exponent, &c) in (n + 1..).zip(piece).filter(|(_, c)| **c != 0.0) {
                if exponent == 0 {
                    logarithms += c * (b / a).ln();
                } else if exponent < 0 && a == 0.0 {
                    logarithms += c * f64::INFINITY;
                } else {
                    let powers =
                        DoubleDouble::power(b, exponent).minus(DoubleDouble::power(a, exponent));
                    sum = sum.plus(powers.times(c).over(f64::from(exponent)));
                }
            }
        }
        sum.value() + logarithms
    }

    /// The radial moment ∫ f(q) qⁿ dq over the whole support.
    ///
    /// ```
    /// // Wendland C2: ∫ f dq = 2/3, hence σ₁ = 3/4.
    /// let kernel = sph_kernels::wendland_c2();
    /// assert!((kernel.shape().moment(0) - 2.0 / 3.0).abs() < 1e-15);
    /// ```
    pub fn moment(&self, n: i32) -> f64 {
        self.integral(n, 0.0, self.support())
    }

    /// σ_d with σ_d ∫ f dV = 1 over the line, the plane or space (d = 1, 2, 3):
    /// 1/(2∫f dq), 1/(2π∫f q dq), 1/(4π∫f q² dq).
    ///
    /// # Panics
    /// If the dimension is not 1, 2 or 3.
    pub fn normalisation(&self, dimension: usize) -> f64 {
        1.0 / (sphere(dimension) * self.moment(dimension as i32 - 1))
    }
}

/// Surface of the unit sphere in d dimensions: 2, 2π, 4π.
pub(crate) fn sphere(dimension: usize) -> f64 {
    match dimension {
        1 => 2.0,
        2 => 2.0 * PI,
        3 => 4.0 * PI,
        _ => panic!("kernels live in 1, 2 or 3 dimensions, not in {dimension}"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn step() -> PiecewisePolynomial {
        PiecewisePolynomial {
            breaks: vec![0.0, 1.0, 2.0],
            pieces: vec![vec![0.0, 3.0], vec![3.0]],
        }
    }

    #[test]
    fn bounds_are_cut_to_the_support_and_oriented() {
        assert_eq!(step().integral(0, 0.5, 9.0), 1.5 * 0.75 + 3.0);
        assert_eq!(step().integral(0, 9.0, 0.5), -(1.5 * 0.75 + 3.0));
        assert_eq!(step().integral(0, 1.0, 1.0), 0.0);
    }

    #[test]
    fn negative_powers_give_logarithms_or_infinity() {
        // ∫₀¹ 3 dq + ∫₁² 3/q dq
        assert!((step().moment(-1) - (3.0 + 3.0 * 2f64.ln())).abs() < 1e-15);
        assert_eq!(step().moment(-2), f64::INFINITY);
        // ∫₁² 3 q⁻³ dq = 9/8
        assert_eq!(step().integral(-3, 1.0, 2.0), 1.125);
    }

    #[test]
    #[should_panic(expected = "not in 4")]
    fn four_dimensions_are_refused() {
        step().normalisation(4);
    }
}
