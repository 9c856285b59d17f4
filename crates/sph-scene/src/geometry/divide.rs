//! Division of curved walls where the scene leaves it open.

use std::f64::consts::{PI, TAU};

/// Largest distance of an edge from the curve, in spacings.
const SAGITTA: f64 = 0.02;
/// Shortest edge, in spacings.
const SHORTEST: f64 = 0.5;

/// Sides of a circle of `radius` spacings: of one spacing, or shorter where the curve asks for
/// it, but not shorter than half a spacing.
pub(crate) fn sides(radius: f64) -> usize {
    let near = (TAU * radius).round();
    let fine = (PI / (1.0 - (SAGITTA / radius).min(1.0)).acos()).ceil();
    let most = (PI / (0.5 * SHORTEST / radius).min(1.0).asin()).floor();
    near.max(fine).min(most).clamp(6.0, 1e5) as usize
}

/// The same where the scene leaves the number of sides open; `radius` and `spacing` in m.
pub(crate) fn sides_of(given: Option<usize>, radius: f64, spacing: f64) -> usize {
    given.unwrap_or_else(|| sides(radius / spacing))
}

/// Parts of every edge of the icosahedron around a sphere of `radius` spacings, by the same rule.
///
/// Of n parts the shortest edge is 0.894/n radii long, the longest 1.323/n and the mean 1.107/n;
/// the middle of the largest triangle is 0.292/n² radii below the sphere.
pub(crate) fn subdivisions(radius: f64) -> usize {
    let near = (1.107 * radius).round();
    let fine = (0.292 * radius / SAGITTA).sqrt().ceil();
    let most = (0.894 * radius / SHORTEST).floor();
    near.max(fine).min(most).clamp(1.0, 500.0) as usize
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn circles_are_round_and_their_sides_not_short() {
        for radius in [2.0, 3.0, 7.0, 40.0, 1000.0] {
            let n = sides(radius) as f64;
            let sagitta = radius * (1.0 - (PI / n).cos());
            let edge = 2.0 * radius * (PI / n).sin();
            let round = sagitta < 0.0201 && edge > 0.499;
            assert!(round, "{radius}: {sagitta} {edge}");
        }
        assert_eq!(sides(40.0), 251);
        assert_eq!(sides(0.1), 6);
        assert_eq!(sides(1e9), 100_000);
        assert_eq!(subdivisions(1e9), 500);
    }
}
