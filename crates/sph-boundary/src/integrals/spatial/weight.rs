//! ∫ w dS over small triangles by quadrature.

use sph_kernels::lanes::Lane;

use super::Renormalisation3d;

/// Squared distance of the centre over the area from which on a rule is used, and the largest area over h² for it.
struct Range {
    distance: f64,
    area: f64,
}

const SIX: Range = Range {
    distance: 2.0,
    area: 0.3,
};
const TWELVE: Range = Range {
    distance: 0.5,
    area: 0.4,
};

/// An orbit of three points: the barycentric coordinate that differs, and the weight of one.
type Orbit = [f64; 2];

/// Six points of degree 4 and twelve of degree 6. Source: Dunavant (1985), doi:10.1002/nme.1620210612.
const SIX_ORBITS: [Orbit; 2] = [
    [0.108_103_018_168_070, 0.223_381_589_678_011],
    [0.816_847_572_980_459, 0.109_951_743_655_322],
];
const TWELVE_ORBITS: [Orbit; 2] = [
    [0.501_426_509_658_179, 0.116_786_275_726_379],
    [0.873_821_971_016_996, 0.050_844_906_370_207],
];
/// The coordinates and the weight of the orbit of six.
const TWELVE_MIXED: [f64; 3] = [
    0.053_145_049_844_817,
    0.310_352_451_033_784,
    0.636_502_499_121_399,
];
const TWELVE_MIXED_WEIGHT: f64 = 0.082_851_075_618_374;

/// Squared distances of the places of a triangle from a point, m².
///
/// With c the vector to the mean of the corners, ξ_i from there to the corners, Σ ξ_i = 0, and Σ λ_i = 1,
///
/// ```text
/// |c + Σ λ_i ξ_i|² = c² + Σ λ_i t_i + |Σ λ_i ξ_i|²,   t_i = 2 c·ξ_i
/// ```
#[derive(Clone, Copy)]
pub(super) struct SquaredDistances<L> {
    /// c².
    pub centre: L,
    /// t_i.
    pub slopes: [L; 3],
    /// ξ_i².
    pub arms: [L; 3],
}

impl Renormalisation3d {
    /// The accurate rule for a squared distance of the centre and an area, m².
    #[inline(always)]
    pub(super) fn rule(&self, centre: f64, area: f64) -> Rule {
        let over_h2 = area * (self.per_h * self.per_h);
        if centre >= SIX.distance * area && over_h2 <= SIX.area {
            Rule::Six
        } else if centre >= TWELVE.distance * area && over_h2 <= TWELVE.area {
            Rule::Twelve
        } else {
            Rule::Exact
        }
    }

    #[inline(never)]
    pub(super) fn mean_of_twelve(&self, seen: &SquaredDistances<f64>) -> f64 {
        let mut squares = [0.0; 12];
        for i in 0..3 {
            squares[i] = seen.orbit(TWELVE_ORBITS[0][0], i);
            squares[3 + i] = seen.orbit(TWELVE_ORBITS[1][0], i);
        }
        squares[6..].copy_from_slice(&seen.mixed_orbit(TWELVE_MIXED));
        let mut w = [0.0; 12];
        self.kernel.value(&squares, &mut w);
        let sum = |w: &[f64]| w.iter().sum::<f64>();
        TWELVE_ORBITS[0][1] * sum(&w[..3])
            + TWELVE_ORBITS[1][1] * sum(&w[3..6])
            + TWELVE_MIXED_WEIGHT * sum(&w[6..])
    }
}

pub(super) enum Rule {
    Six,
    Twelve,
    Exact,
}

/// True if [`Rule::Six`] holds for all lanes: squared distances of the centres and areas, m², and 1/h².
#[inline(always)]
pub(super) fn is_far<L: Lane>(centre: L, area: L, per_h2: f64) -> bool {
    let near = centre.any_less(L::splat(SIX.distance) * area);
    let large = L::splat(SIX.area).any_less(area * L::splat(per_h2));
    !(near || large)
}

#[inline(always)]
pub(super) fn mean_of_six<L: Lane>(w: [L; POINTS]) -> L {
    let (first, second) = (L::splat(SIX_ORBITS[0][1]), L::splat(SIX_ORBITS[1][1]));
    first * (w[0] + w[1] + w[2]) + second * (w[3] + w[4] + w[5])
}

pub(super) const POINTS: usize = 6;

impl<L: Lane> SquaredDistances<L> {
    /// From the coordinates of the centre in a plane, the squared height over it, the first two of ξ_i, and all ξ_i².
    #[inline(always)]
    pub fn new([x, y]: [L; 2], height2: L, [a, b]: [[L; 2]; 2], arms: [L; 3]) -> Self {
        let two = L::splat(2.0);
        let first = two * (x * a[0] + y * a[1]);
        let second = two * (x * b[0] + y * b[1]);
        SquaredDistances {
            centre: x * x + y * y + height2,
            slopes: [first, second, -(first + second)],
            arms,
        }
    }

    /// Those of the six points, the two orbits one behind the other.
    #[inline(always)]
    pub fn six(&self) -> [L; POINTS] {
        let mut squares = [self.centre; POINTS];
        for orbit in 0..2 {
            for k in 0..3 {
                squares[3 * orbit + k] = self.orbit(SIX_ORBITS[orbit][0], k);
            }
        }
        squares
    }

    /// With λ in the place i and (1 − λ)/2 in the others: Σ λ_i ξ_i = ξ_i (3λ − 1)/2.
    #[inline(always)]
    fn orbit(&self, single: f64, i: usize) -> L {
        let part = L::splat(1.5 * single - 0.5);
        self.centre + part * (self.slopes[i] + part * self.arms[i])
    }
}

impl SquaredDistances<f64> {
    /// With ξ_k = −ξ_i − ξ_j: Σ λ_i ξ_i = (λ_i − λ_k) ξ_i + (λ_j − λ_k) ξ_j.
    #[inline(always)]
    fn mixed_orbit(&self, [a, b, c]: [f64; 3]) -> [f64; 6] {
        let (t, s) = (self.slopes, self.arms);
        let (p, q) = (a - c, b - c);
        let at = |i: usize, j: usize, k: usize| {
            let product = s[k] - s[i] - s[j];
            let square = p * p * s[i] + q * q * s[j] + p * q * product;
            self.centre + (a * t[i] + b * t[j] + c * t[k]) + square
        };
        [
            at(0, 1, 2),
            at(0, 2, 1),
            at(1, 2, 0),
            at(1, 0, 2),
            at(2, 0, 1),
            at(2, 1, 0),
        ]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::vector::{along, dot};

    #[test]
    fn the_rules_have_their_degree() {
        // ∫ λⁿ dA / area = 2 n! / (n + 2)!; without arms a square is a linear function.
        let value = SquaredDistances {
            centre: 1.0 / 3.0,
            slopes: [-1.0 / 3.0, 2.0 / 3.0, -1.0 / 3.0],
            arms: [0.0; 3],
        };
        let factorial = |n: i32| (1..=n).map(f64::from).product::<f64>();
        let orbits = |orbits: [Orbit; 2], n: i32| -> f64 {
            let sum = |single| (0..3).map(|i| value.orbit(single, i).powi(n)).sum::<f64>();
            let parts = orbits.map(|[single, weight]| weight * sum(single));
            parts.into_iter().sum()
        };
        for n in 0..=6 {
            let exact = 2.0 * factorial(n) / factorial(n + 2);
            let mixed = value.mixed_orbit(TWELVE_MIXED).map(|x| x.powi(n));
            let mixed = TWELVE_MIXED_WEIGHT * mixed.iter().sum::<f64>();
            let twelve = (orbits(TWELVE_ORBITS, n) + mixed - exact).abs();
            assert!(twelve < 1e-14, "degree {n}: {twelve}");
            let six = (orbits(SIX_ORBITS, n) - exact).abs();
            assert!(n > 4 || six < 1e-14, "degree {n}: {six}");
        }
    }

    #[test]
    fn squares_are_those_of_the_points() {
        let corners = [[0.3, 0.2, 1.0], [0.9, -0.4, 0.8], [-0.1, 0.5, 1.3]];
        let square = |l: [f64; 3]| {
            let p = [0, 1, 2].map(|x: usize| (0..3).map(|i| l[i] * corners[i][x]).sum::<f64>());
            dot(p, p)
        };
        let centre = [0, 1, 2].map(|x: usize| corners.iter().map(|c| c[x]).sum::<f64>() / 3.0);
        let arms = corners.map(|c| along(c, -1.0, centre));
        let seen = SquaredDistances {
            centre: dot(centre, centre),
            slopes: arms.map(|arm| 2.0 * dot(centre, arm)),
            arms: arms.map(|arm| dot(arm, arm)),
        };
        let (three, six) = (
            [0, 1, 2].map(|i| seen.orbit(0.6, i)),
            seen.mixed_orbit([0.1, 0.2, 0.7]),
        );
        let close = |a: f64, b: f64| assert!((a - b).abs() < 1e-15, "{a} {b}");
        close(three[1], square([0.2, 0.6, 0.2]));
        close(six[0], square([0.1, 0.2, 0.7]));
        close(six[1], square([0.1, 0.7, 0.2]));
        close(six[2], square([0.7, 0.1, 0.2]));
        close(six[5], square([0.7, 0.2, 0.1]));
    }
}
