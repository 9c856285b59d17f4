//! ∫ w dS over small triangles by quadrature.

use super::Renormalisation3d;
use super::vector::{dot, plus};

/// Squared distance of the centre over the area from which on a rule is used, and the largest
/// area over h² for it.
struct Range {
    distance: f64,
    area: f64,
}

const SIX: Range = Range {
    distance: 2.0,
    area: 0.15,
};
const TWELVE: Range = Range {
    distance: 0.5,
    area: 0.4,
};

/// An orbit of three points: the barycentric coordinate that differs, and the weight of one.
type Orbit = [f64; 2];

/// Six points of degree 4 and twelve of degree 6. Source: Dunavant (1985),
/// doi:10.1002/nme.1620210612.
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

/// Squares of the distances to the corners and of the sides opposite to them.
#[derive(Clone, Copy)]
struct Squares {
    corners: [f64; 3],
    sides: [f64; 3],
}

impl Renormalisation3d {
    /// ∫ w dS over a triangle, 1/m: by quadrature where that is accurate, else exactly.
    ///
    /// For many triangles with legs of about h/2 of which only shares are needed, the sum being
    /// known from [`polygon`](Self::polygon). Six points where the centre is a leg or more away,
    /// twelve for half a leg, and the closed form below that and for triangles larger than h.
    /// Measured for right isosceles triangles with legs h/2: within 7·10⁻⁵ w(0) · area; of the
    /// triangle's own largest w · area, 10⁻⁴ (3·10⁻⁴ for Wendland C6) unless a corner is within a
    /// leg of the support's end.
    #[inline]
    pub fn weight(&self, corners: [[f64; 3]; 3], normal: [f64; 3], area: f64) -> f64 {
        let [a, b, c] = corners;
        let side = |a: [f64; 3], b: [f64; 3]| {
            let d = plus(a, -1.0, b);
            dot(d, d)
        };
        let seen = Squares {
            corners: [dot(a, a), dot(b, b), dot(c, c)],
            sides: [side(b, c), side(c, a), side(a, b)],
        };
        let centre = seen.centre();
        let over_h2 = area * (self.per_h * self.per_h);
        if centre >= SIX.distance * area && over_h2 <= SIX.area {
            let corners = seen.corners;
            if self.table.holds(corners[0].max(corners[1]).max(corners[2])) {
                return area * seen.mean(SIX_ORBITS, |r2| self.table.inside(r2));
            }
            area * seen.mean(SIX_ORBITS, |r2| self.table.at(r2))
        } else if centre >= TWELVE.distance * area && over_h2 <= TWELVE.area {
            area * self.mean_of_twelve(&seen)
        } else {
            self.triangle(corners, normal).kernel
        }
    }

    #[inline(never)]
    fn mean_of_twelve(&self, seen: &Squares) -> f64 {
        let mut sum = 0.0;
        for r2 in seen.mixed_orbit(TWELVE_MIXED) {
            sum += self.table.at(r2);
        }
        seen.mean(TWELVE_ORBITS, |r2| self.table.at(r2)) + TWELVE_MIXED_WEIGHT * sum
    }
}

/// |Σ λ_i r_i|² = Σ λ_i r_i² − Σ λ_j λ_k s_i² with s_i the side opposite to the corner i and
/// Σ λ_i = 1.
impl Squares {
    #[inline(always)]
    fn centre(&self) -> f64 {
        let (r, s) = (self.corners, self.sides);
        (r[0] + r[1] + r[2]) * (1.0 / 3.0) - (s[0] + s[1] + s[2]) * (1.0 / 9.0)
    }

    /// Weighted sum over two orbits of three.
    #[inline(always)]
    fn mean(&self, orbits: [Orbit; 2], w: impl Fn(f64) -> f64) -> f64 {
        let sum = |single: f64| {
            let r2 = self.orbit(single);
            w(r2[0]) + w(r2[1]) + w(r2[2])
        };
        orbits[0][1] * sum(orbits[0][0]) + orbits[1][1] * sum(orbits[1][0])
    }

    #[inline(always)]
    fn orbit(&self, single: f64) -> [f64; 3] {
        let other = 0.5 * (1.0 - single);
        let (r, s) = (self.corners, self.sides);
        let common = other * (r[0] + r[1] + r[2]) - other * single * (s[0] + s[1] + s[2]);
        let at = |i: usize| common + (single - other) * (r[i] + other * s[i]);
        [at(0), at(1), at(2)]
    }

    #[inline(always)]
    fn mixed_orbit(&self, [a, b, c]: [f64; 3]) -> [f64; 6] {
        let (r, s) = (self.corners, self.sides);
        let at = |i: usize, j: usize, k: usize| {
            let corners = a * r[i] + b * r[j] + c * r[k];
            corners - (b * c * s[i] + c * a * s[j] + a * b * s[k])
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

    #[test]
    fn the_rules_have_their_degree() {
        // ∫ λⁿ dA / area = 2 n! / (n + 2)!; without sides a square is a linear function.
        let value = Squares {
            corners: [0.0, 1.0, 0.0],
            sides: [0.0; 3],
        };
        let factorial = |n: i32| (1..=n).map(f64::from).product::<f64>();
        let orbits = |orbits: [Orbit; 2], n: i32| -> f64 {
            let sum = |single| value.orbit(single).iter().map(|x| x.powi(n)).sum::<f64>();
            orbits
                .iter()
                .map(|[single, weight]| weight * sum(*single))
                .sum()
        };
        for n in 0..=6 {
            let exact = 2.0 * factorial(n) / factorial(n + 2);
            let mixed = value.mixed_orbit(TWELVE_MIXED).map(|x| x.powi(n));
            let mixed = TWELVE_MIXED_WEIGHT * mixed.iter().sum::<f64>();
            let twelve = orbits(TWELVE_ORBITS, n) + mixed;
            assert!(
                (twelve - exact).abs() < 1e-14,
                "degree {n}: {twelve} {exact}"
            );
            let six = orbits(SIX_ORBITS, n);
            assert!(
                n > 4 || (six - exact).abs() < 1e-14,
                "degree {n}: {six} {exact}"
            );
        }
    }

    #[test]
    fn squares_are_those_of_the_points() {
        let corners = [[0.3, 0.2, 1.0], [0.9, -0.4, 0.8], [-0.1, 0.5, 1.3]];
        let square = |l: [f64; 3]| {
            let p = [0, 1, 2].map(|x: usize| (0..3).map(|i| l[i] * corners[i][x]).sum::<f64>());
            dot(p, p)
        };
        let side = |i: usize, j: usize| {
            let d = [0, 1, 2].map(|x: usize| corners[i][x] - corners[j][x]);
            dot(d, d)
        };
        let seen = Squares {
            corners: corners.map(|c| dot(c, c)),
            sides: [side(1, 2), side(2, 0), side(0, 1)],
        };
        assert!((seen.centre() - square([1.0 / 3.0; 3])).abs() < 1e-15);
        let (three, six) = (seen.orbit(0.6), seen.mixed_orbit([0.1, 0.2, 0.7]));
        let close = |a: f64, b: f64| assert!((a - b).abs() < 1e-15, "{a} {b}");
        close(three[1], square([0.2, 0.6, 0.2]));
        close(six[0], square([0.1, 0.2, 0.7]));
        close(six[1], square([0.1, 0.7, 0.2]));
        close(six[2], square([0.7, 0.1, 0.2]));
        close(six[5], square([0.7, 0.2, 0.1]));
    }
}
