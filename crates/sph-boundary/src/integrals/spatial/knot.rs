//! Tables of the closed forms, one polynomial per knot of the kernel, and of the first moment of the kernel.

use std::f64::consts::PI;

use sph_kernels::PiecewisePolynomial;

use crate::integrals::steps;

/// The part Δ(q) = Σ c_n qⁿ of the kernel that ends at one knot.
///
/// With b_n the factors of U_{n+2} and, downwards in n, b'_n = b_n + Q² b'_{n+2} and
/// p_n = b'_n/(n + 1) + A² p_{n+2} (n + 2)/(n + 1),
///
/// ```text
/// Σ b_n U_{n+2} = D y P(q) + D (A² p_1 + Q² b'_1) asinh(y/A) − Q³ b'_1 Θ,   P = Σ p_n qⁿ
/// ```
#[derive(Clone, Debug)]
pub(super) struct Knot {
    /// ρ, the knot over h.
    pub radius: f64,
    pub radius_squared: f64,
    /// K_ρ = 4πσ ∫₀^ρ Δ q² dq; these sum to 1.
    pub charge: f64,
    /// Σ b_n ρⁿ⁺² of both sums.
    at_radius: [f64; 2],
    /// For n = N, …, 0.
    terms: Vec<Term>,
}

#[derive(Clone, Copy, Debug)]
struct Term {
    /// 1/(n + 1).
    inverse: f64,
    /// (n + 2)/(n + 1).
    ratio: f64,
    /// b_n: σ c_n/(n + 2) for ∫ w dS and −4πσ c_n/((n + 2)(n + 3)) for Γ_as.
    factors: [f64; 2],
}

pub(super) type End = crate::integrals::End<f64>;

/// Σ b_n U_{n+2} of both sums, split by the factor that is still to come.
pub(super) struct Primitives {
    /// Factors of D.
    pub plain: [f64; 2],
    /// Factors of D [asinh(y/A)].
    pub logarithm: [f64; 2],
    /// Factors of −Θ.
    pub angle: [f64; 2],
}

impl Knot {
    /// The integrals between two ends inside the knot's sphere, with `depth` = Q and `a2` = A².
    #[inline]
    pub fn between(&self, depth: f64, a2: f64, from: End, to: End) -> Primitives {
        let depth2 = depth * depth;
        // b' and p for n + 1 and n + 2.
        let (mut b1, mut b2, mut p1, mut p2) = ([0.0; 2], [0.0; 2], [0.0; 2], [0.0; 2]);
        let (mut at_from, mut at_to) = ([0.0; 2], [0.0; 2]);
        for term in &self.terms {
            let up = term.ratio * a2;
            for i in 0..2 {
                let b = term.factors[i] + depth2 * b2[i];
                let p = term.inverse * b + up * p2[i];
                (b2[i], b1[i], p2[i], p1[i]) = (b1[i], b, p1[i], p);
                at_from[i] = at_from[i] * from.q + p;
                at_to[i] = at_to[i] * to.q + p;
            }
        }
        // b2 and p2 are now those of n = 1.
        Primitives {
            plain: [0, 1].map(|i| to.y * at_to[i] - from.y * at_from[i]),
            logarithm: [0, 1].map(|i| a2 * p2[i] + depth2 * b2[i]),
            angle: [0, 1].map(|i| depth2 * depth * b2[i]),
        }
    }

    /// Σ b_n (ρⁿ⁺² − Qⁿ⁺²), the factors of φ outside the sphere.
    #[inline]
    pub fn outside(&self, depth: f64) -> [f64; 2] {
        let mut sum = [0.0; 2];
        for term in &self.terms {
            for (sum, factor) in sum.iter_mut().zip(term.factors) {
                *sum = *sum * depth + factor;
            }
        }
        let depth2 = depth * depth;
        [0, 1].map(|i| self.at_radius[i] - sum[i] * depth2)
    }
}

/// Knots from the outermost inwards.
pub(super) fn tables(shape: &PiecewisePolynomial, sigma: f64) -> Vec<Knot> {
    let all = steps(shape).into_iter();
    all.map(|(radius, step)| knot(radius, step, sigma))
        .collect()
}

fn knot(radius: f64, mut step: Vec<f64>, sigma: f64) -> Knot {
    let last = step.iter().rposition(|c| *c != 0.0).unwrap_or(0);
    step.truncate(last + 1);
    let terms = step.iter().enumerate().rev().map(|(n, c)| {
        let n = n as f64;
        let kernel = sigma * c / (n + 2.0);
        Term {
            inverse: 1.0 / (n + 1.0),
            ratio: (n + 2.0) / (n + 1.0),
            factors: [kernel, -4.0 * PI * kernel / (n + 3.0)],
        }
    });
    let terms = terms.collect();
    let alone = PiecewisePolynomial {
        breaks: vec![0.0, radius],
        pieces: vec![step],
    };
    let mut knot = Knot {
        radius,
        radius_squared: radius * radius,
        charge: 4.0 * PI * sigma * alone.moment(2),
        at_radius: [0.0; 2],
        terms,
    };
    // σ ∫₀^ρ Δ q dq, and −∫₀^ρ (K_ρ − K)/q² dq by parts, in doubled precision.
    let first = alone.moment(1);
    knot.at_radius = [
        sigma * first,
        knot.charge / radius - 4.0 * PI * sigma * first,
    ];
    knot
}

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
    fn charges_sum_to_one_and_nothing_is_outside_at_the_knot() {
        for kernel in sph_kernels::builtin() {
            let shape = kernel.shape();
            let knots = tables(shape, shape.normalisation(3));
            let sum: f64 = knots.iter().map(|knot| knot.charge).sum();
            assert!((sum - 1.0).abs() < 1e-14, "{sum}");
            for knot in &knots {
                let rest = knot.outside(knot.radius);
                let size = |i: usize| -> f64 {
                    let terms = knot.terms.iter();
                    let add = |sum: f64, term: &Term| sum * knot.radius + term.factors[i].abs();
                    terms.fold(0.0, add) * knot.radius_squared
                };
                for (i, rest) in rest.into_iter().enumerate() {
                    assert!(rest.abs() <= 1e-15 * size(i), "{rest:e} of {:e}", size(i));
                }
            }
        }
    }

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
