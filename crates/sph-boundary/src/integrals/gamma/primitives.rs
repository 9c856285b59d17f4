//! Tables of the closed forms: one polynomial per knot of the kernel, as long as it does not cancel.
//!
//! Near the support the monomials of a kernel of high degree cancel: at q = 2 those of Wendland C6 sum
//! 17 000 to 0, and the closed form would lose four digits. There, at q of the order of the support,
//! the integrands are smooth along a segment, the nearest singularity being at y = ± i a, and a short
//! Gauss–Legendre rule of the kernel expanded about the middle of the ring is exact to rounding.

use std::f64::consts::TAU;

use sph_kernels::lanes::Lane;
use sph_kernels::{PiecewisePolynomial, algebra};

use crate::integrals::{End, steps};

/// The part Δ(q) = Σ c_n qⁿ of the kernel that ends at one knot.
///
/// Σ c_n I_n = y P(q) + a² p_1 asinh(y/a) with P = Σ p_n qⁿ and, downwards in n,
/// p_n = c_n/(n + 1) + a² p_{n+2} (n + 2)/(n + 1).
#[derive(Clone, Debug)]
pub(super) struct Knot {
    /// ρ, the knot over h.
    pub radius: f64,
    /// C/2π = σ ∫₀^ρ Δ q dq.
    pub angle: f64,
    /// For n = N, …, 0.
    terms: Vec<Term>,
}

#[derive(Clone, Copy, Debug)]
struct Term {
    /// (n + 2)/(n + 1).
    ratio: f64,
    /// σ c_n/(n + 1).
    gradient: f64,
    /// σ c_n/((n + 1)(n + 2)).
    gamma: f64,
}

/// σ Σ c_n I_n and σ Σ c_n I_n/(n + 2), without and with the logarithm's factor.
pub(super) struct Primitives<L> {
    pub gradient: L,
    pub gamma: L,
    /// Factors of asinh(y₂/a) − asinh(y₁/a) still to be added to both.
    pub gradient_log: L,
    pub gamma_log: L,
}

impl Knot {
    /// Differences between two ends of everything except the logarithm and the angle.
    #[inline(always)]
    pub fn between<L: Lane>(&self, a2: L, from: End<L>, to: End<L>) -> Primitives<L> {
        let zero = L::splat(0.0);
        // p_{n+1} and p_{n+2} of both sums.
        let (mut g1, mut g2, mut s1, mut s2) = (zero, zero, zero, zero);
        let (mut g_from, mut g_to, mut s_from, mut s_to) = (zero, zero, zero, zero);
        for term in &self.terms {
            let up = L::splat(term.ratio) * a2;
            let g = L::splat(term.gradient) + up * g2;
            let s = L::splat(term.gamma) + up * s2;
            (g2, g1, s2, s1) = (g1, g, s1, s);
            g_from = g_from * from.q + g;
            g_to = g_to * to.q + g;
            s_from = s_from * from.q + s;
            s_to = s_to * to.q + s;
        }
        Primitives {
            gradient: to.y * g_to - from.y * g_from,
            gamma: to.y * s_to - from.y * s_from,
            gradient_log: g2 * a2,
            gamma_log: s2 * a2,
        }
    }
}

/// The closed form serves up to this amplification of rounding, about 10⁻¹⁴ in γ and h∇γ.
const AMPLIFICATION: f64 = 60.0;

/// Discs of the closed form from the outermost inwards, and rings left to quadrature.
///
/// Normally every knot has its disc and there are no rings. Where rounding would be amplified too
/// much, all pieces but the first become rings, and of the first one as much as needed: the disc
/// that remains has the whole kernel around it, K(0) = 1.
pub(super) fn tables(shape: &PiecewisePolynomial, sigma: f64) -> (Vec<Knot>, Vec<Ring>) {
    let steps = steps(shape);
    let worst = |amplified: f64, (radius, step): &(f64, Vec<f64>)| {
        amplified.max(amplification(step, *radius, sigma))
    };
    if steps.iter().fold(0.0, worst) <= AMPLIFICATION {
        let knots = steps.into_iter();
        let knots = knots.map(|(radius, step)| knot(radius, step, sigma));
        return (knots.collect(), Vec::new());
    }
    let pieces = shape.pieces.iter().zip(shape.breaks.windows(2)).rev();
    let mut rings = Vec::new();
    for (piece, bounds) in pieces.filter(|(_, bounds)| bounds[0] > 0.0) {
        rings.push(Ring::new(shape, piece, [bounds[0], bounds[1]], sigma));
    }
    let (piece, mut radius) = (&shape.pieces[0], shape.breaks[1]);
    while amplification(piece, radius, sigma) > AMPLIFICATION {
        rings.push(Ring::new(shape, piece, [0.5 * radius, radius], sigma));
        radius *= 0.5;
    }
    let disc = Knot {
        angle: 1.0 / TAU,
        ..knot(radius, piece.clone(), sigma)
    };
    (vec![disc], rings)
}

fn knot(radius: f64, step: Vec<f64>, sigma: f64) -> Knot {
    let last = step.iter().rposition(|c| *c != 0.0).unwrap_or(0);
    let term = |n: usize| {
        let (n1, n2) = (n as f64 + 1.0, n as f64 + 2.0);
        let c = step[n] * sigma;
        Term {
            ratio: n2 / n1,
            gradient: c / n1,
            gamma: c / (n1 * n2),
        }
    };
    let terms = (0..=last).rev().map(term).collect();
    let alone = PiecewisePolynomial {
        breaks: vec![0.0, radius],
        pieces: vec![step],
    };
    // σ ∫ Δ q dq = (1/2π) · 2πσ ∫ Δ q dq, in the order that makes a single knot exactly 1/2π.
    let angle = alone.moment(1) * (TAU * sigma) / TAU;
    Knot {
        radius,
        angle,
        terms,
    }
}

/// Part of the distance to the point that one panel of a rule may be long.
const SHORT_PANEL: f64 = 0.5;

/// Nodes on [0, 1) of the symmetric rules with weights for [−1, 1]: 8 points for panels up to half
/// the distance to the point, error below 8.1⁻¹⁶ of the integrand; 14 up to the distance, 4.2⁻²⁸.
const SHORT_RULE: [[f64; 2]; 4] = [
    [0.1834346424956498, 0.362683783378362],
    [0.525532409916329, 0.31370664587788727],
    [0.7966664774136267, 0.22238103445337448],
    [0.9602898564975363, 0.10122853629037626],
];
const LONG_RULE: [[f64; 2]; 7] = [
    [0.10805494870734367, 0.2152638534631578],
    [0.31911236892788974, 0.2051984637212956],
    [0.5152486363581541, 0.18553839747793782],
    [0.6872929048116855, 0.15720316715819355],
    [0.827201315069765, 0.12151857068790319],
    [0.9284348836635735, 0.08015808715976021],
    [0.9862838086968123, 0.03511946033175186],
];

/// The kernel on inner ≤ q < outer, where it is one polynomial.
#[derive(Clone, Debug)]
pub(super) struct Ring {
    pub inner: f64,
    pub outer: f64,
    middle: f64,
    /// σ f and K/2π in powers of q − middle, from the highest; σ f starts with zeros.
    terms: Vec<[f64; 2]>,
}

impl Ring {
    pub fn new(shape: &PiecewisePolynomial, piece: &[f64], ends: [f64; 2], sigma: f64) -> Self {
        let [inner, outer] = ends;
        let middle = 0.5 * (inner + outer);
        let f = algebra::scaled(&algebra::expanded_about(piece, middle), sigma);
        // σ f q, its primitive G, and K/2π = K(outer)/2π + G(outer) − G.
        let at = |n: usize| f.get(n).copied().unwrap_or(0.0);
        let fq = |n: usize| middle * at(n) + if n > 0 { at(n - 1) } else { 0.0 };
        let mut k: Vec<f64> = vec![0.0];
        k.extend((0..=f.len()).map(|n| -fq(n) / (n as f64 + 1.0)));
        let half = outer - middle;
        k[0] = sigma * shape.integral(1, outer, shape.support()) - algebra::value(&k, half);
        let terms = (0..k.len()).rev().map(|n| [at(n), k[n]]).collect();
        Self {
            inner,
            outer,
            middle,
            terms,
        }
    }

    /// σ ∫ f dy and ∫ K/(2π q²) dy over the part of [`from`, `to`] in the ring.
    #[inline]
    pub fn integrals(&self, a: f64, from: f64, to: f64) -> [f64; 2] {
        let outer = ((self.outer - a) * (self.outer + a)).sqrt();
        if a.abs() >= self.inner {
            return self.panels(a, from.max(-outer), to.min(outer));
        }
        let inner = ((self.inner - a) * (self.inner + a)).sqrt();
        let left = self.panels(a, from.max(-outer), to.min(-inner));
        let right = self.panels(a, from.max(inner), to.min(outer));
        [left[0] + right[0], left[1] + right[1]]
    }

    fn panels(&self, a: f64, from: f64, to: f64) -> [f64; 2] {
        let length = to - from;
        if length <= 0.0 {
            return [0.0; 2];
        }
        let nearest = a.abs().max(self.inner);
        if length <= SHORT_PANEL * nearest {
            return self.panel(&SHORT_RULE, a, from, to);
        }
        let count = (length / nearest).ceil();
        let step = length / count;
        let mut sum = [0.0; 2];
        for i in 0..count as u32 {
            let start = from + step * f64::from(i);
            let part = self.panel(&LONG_RULE, a, start, start + step);
            sum = [sum[0] + part[0], sum[1] + part[1]];
        }
        sum
    }

    #[inline]
    fn panel(&self, rule: &[[f64; 2]], a: f64, from: f64, to: f64) -> [f64; 2] {
        let (centre, half) = (0.5 * (from + to), 0.5 * (to - from));
        let mut sum = [0.0; 2];
        for [node, weight] in rule {
            let y = [centre - half * node, centre + half * node];
            let q2 = y.map(|y| a * a + y * y);
            let s = q2.map(|q2| q2.sqrt() - self.middle);
            let (mut f, mut k) = ([0.0; 2], [0.0; 2]);
            for [f_n, k_n] in &self.terms {
                f = [f[0] * s[0] + f_n, f[1] * s[1] + f_n];
                k = [k[0] * s[0] + k_n, k[1] * s[1] + k_n];
            }
            sum[0] += weight * (f[0] + f[1]);
            sum[1] += weight * (k[0] / q2[0] + k[1] / q2[1]);
        }
        sum.map(|x| x * half)
    }
}

/// σ Σ |c_n| ρⁿ⁺¹/(n + 1): the factor by which the closed form amplifies rounding.
pub(super) fn amplification(piece: &[f64], radius: f64, sigma: f64) -> f64 {
    let term = |(n, c): (usize, &f64)| c.abs() * radius.powi(n as i32 + 1) / (n as f64 + 1.0);
    sigma * piece.iter().enumerate().map(term).sum::<f64>()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rules_integrate_their_degree() {
        for (rule, degree) in [(&SHORT_RULE[..], 14), (&LONG_RULE[..], 26)] {
            let sum: f64 = rule.iter().map(|[x, w]| 2.0 * w * x.powi(degree)).sum();
            let off = (sum - 2.0 / (f64::from(degree) + 1.0)).abs();
            assert!(off < 1e-15, "degree {degree}");
        }
    }

    #[test]
    fn the_ring_of_wendland_c6_is_as_its_product_form() {
        let kernel = sph_kernels::wendland_c6();
        let shape = kernel.shape();
        let sigma = shape.normalisation(2);
        let ring = Ring::new(shape, &shape.pieces[0], [1.0, 2.0], sigma);
        for i in 0..=20 {
            let q = 1.0 + 0.05 * f64::from(i);
            let [f, k] = ring.terms.iter().fold([0.0; 2], |sum, term| {
                [0, 1].map(|i: usize| sum[i] * (q - ring.middle) + term[i])
            });
            let product = (1.0 - 0.5 * q).powi(8) * (1.0 + q * (4.0 + q * (6.25 + 4.0 * q)));
            let off = f - sigma * product;
            assert!(off.abs() < 1e-16, "f at {q}: {off:e}");
            let exact = sigma * shape.integral(1, q, 2.0);
            assert!((k - exact).abs() < 1e-16, "K at {q}: {:e}", k - exact);
        }
    }
}
