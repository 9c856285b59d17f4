//! Tables of the closed forms: one polynomial per knot of the kernel, as long as it does not cancel.

use std::f64::consts::TAU;

use sph_kernels::PiecewisePolynomial;
use sph_kernels::lanes::Lane;

use super::ring::{Ring, amplification};
use crate::integrals::normalisation::{End, steps};

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
