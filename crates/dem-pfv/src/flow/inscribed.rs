//! The circle between the discs and walls of a facet.

use nalgebra::{Matrix3, Vector3};

use crate::flow::facet::Facet;

/// Radius r (m) of the circle in a facet's plane that touches its discs from outside and its walls: with c from
/// the first centre, |c|² = (r + R₀)², and for each of the other two
///
/// ```text
/// disc    2 d · c + 2 (R_k − R₀) r = |d|² − R_k² + R₀²,     wall    n · c − r = −(distance of x₀)
/// ```
///
/// c is linear in r, and r the least positive root of a quadratic equation. None if there is no such circle.
pub fn inscribed_radius(facet: &Facet, normal: Vector3<f64>) -> Option<f64> {
    let first = facet.spheres[0];
    let discs = facet.spheres[1..].iter().map(|s| {
        let d = s.centre - first.centre;
        let weights = (first.radius - s.radius) * (first.radius + s.radius);
        (
            2.0 * d,
            d.norm_squared() + weights,
            -2.0 * (s.radius - first.radius),
        )
    });
    let walls = facet
        .walls
        .iter()
        .map(|w| (w.normal, -w.distance(first.centre), 1.0));
    let rows: Vec<_> = discs.chain(walls).collect();
    let [(a, a0, a1), (b, b0, b1)] = *rows else {
        return None;
    };
    let matrix = Matrix3::from_rows(&[a.transpose(), b.transpose(), normal.transpose()]);
    let inverse = matrix.try_inverse()?;
    let (u, v) = (
        inverse * Vector3::new(a0, b0, 0.0),
        inverse * Vector3::new(a1, b1, 0.0),
    );
    let square = v.norm_squared() - 1.0;
    let linear = u.dot(&v) - first.radius;
    let constant = u.norm_squared() - first.radius * first.radius;
    // Without cancellation, also where the square's factor vanishes.
    let root = (linear * linear - square * constant).sqrt();
    let sum = -(linear + root.copysign(linear));
    let roots = [sum / square, constant / sum];
    let positive = roots.into_iter().filter(|r| *r > 0.0 && r.is_finite());
    positive.min_by(f64::total_cmp)
}
