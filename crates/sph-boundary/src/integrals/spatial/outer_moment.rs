//! The first moment of the kernel beyond a distance.

use sph_kernels::PiecewisePolynomial;

const INTERVALS: usize = 256;

/// Gauss–Legendre abscissae over half the interval, and weights; exact to degree 9.
const FIVE: [[f64; 2]; 3] = [
    [0.0, 0.568_888_888_888_888_9],
    [0.538_469_310_105_683_1, 0.478_628_670_499_366_5],
    [0.906_179_845_938_664, 0.236_926_885_056_189_1],
];

/// G(q) = σ ∫_q^Q f s ds, Q the support over h: with ρ the vector from the foot of a point in a plane, w ρ = −∇G, and
///
/// ```text
/// ∫_S ρ w dS = ∮ G n dl      n the normal of the edge in the plane, into the face
/// ```
///
/// From a table of cubic parabolas, within 10⁻⁸ G(0).
#[derive(Clone, Debug)]
pub(super) struct OuterMoment {
    per_step: f64,
    /// G and its slope times the step.
    values: Vec<[f64; 2]>,
}

impl OuterMoment {
    pub fn new(shape: &PiecewisePolynomial, sigma: f64) -> Self {
        let step = shape.support() / INTERVALS as f64;
        let integrand = |q: f64| sigma * shape.value(q) * q;
        let mut values = vec![[0.0; 2]; INTERVALS + 1];
        for k in (0..INTERVALS).rev() {
            let middle = (k as f64 + 0.5) * step;
            values[k] = [
                values[k + 1][0] + quadrature([middle, 0.5 * step], integrand),
                -integrand(k as f64 * step) * step,
            ];
        }
        OuterMoment {
            per_step: 1.0 / step,
            values,
        }
    }

    /// G at a distance over h.
    #[inline]
    pub fn at(&self, q: f64) -> f64 {
        let place = q * self.per_step;
        let k = place as usize;
        let (Some([a, da]), Some([b, db])) = (self.values.get(k), self.values.get(k + 1)) else {
            return 0.0;
        };
        let x = place - k as f64;
        let rise = b - a;
        a + x * (da + x * ((3.0 * rise - 2.0 * da - db) + x * (da + db - 2.0 * rise)))
    }

    /// ∫ G dy along a line at the squared distance A², between two abscissae over h.
    #[inline]
    pub fn along(&self, a2: f64, from: f64, to: f64) -> f64 {
        let part = |from: f64, to: f64| {
            let interval = [0.5 * (from + to), 0.5 * (to - from)];
            quadrature(interval, |y| self.at((a2 + y * y).sqrt()))
        };
        match from < 0.0 && to > 0.0 {
            true => part(from, 0.0) + part(0.0, to),
            false => part(from, to),
        }
    }
}

/// Integral over an interval of some middle and half length.
#[inline(always)]
fn quadrature([middle, half]: [f64; 2], of: impl Fn(f64) -> f64) -> f64 {
    let [centre, inner, outer] = FIVE;
    let both = |[x, weight]: [f64; 2]| weight * (of(middle - half * x) + of(middle + half * x));
    half * (centre[1] * of(middle) + both(inner) + both(outer))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_table_is_the_integral() {
        for kernel in sph_kernels::builtin() {
            let shape = kernel.shape();
            let sigma = shape.normalisation(3);
            let of = OuterMoment::new(shape, sigma);
            let whole = sigma * shape.moment(1);
            assert!((of.at(0.0) - whole).abs() < 1e-8 * whole);
            let support = shape.support();
            // The slope is −w q: by differences.
            for k in 1..40 {
                let q = 0.025 * f64::from(k) * support;
                let slope = (of.at(q + 1e-5) - of.at(q - 1e-5)) / 2e-5;
                let off = (slope + sigma * shape.value(q) * q).abs();
                assert!(off < 1e-5 * whole, "{q}");
            }
            assert_eq!(of.at(support * 1.5), 0.0);
        }
    }
}
