//! Distances to an ellipse.

/// Distance of a point from an ellipse about the origin, m, positive inside.
///
/// The nearest point (a²x/(t + a²), b²y/(t + b²)) has the root t of
/// (ax/(t + a²))² + (by/(t + b²))² = 1 that is larger than −b²; a is the larger semi-axis.
///
/// Source: Eberly 2013, Distance from a point to an ellipse, §2.
pub(crate) fn depth(semi_axes: [f64; 2], x: [f64; 2]) -> f64 {
    let turned = semi_axes[0] < semi_axes[1];
    let order = |v: [f64; 2]| if turned { [v[1], v[0]] } else { v };
    let [a, b] = order(semi_axes);
    let [x, y] = order(x.map(f64::abs));
    let inside = (x / a).powi(2) + (y / b).powi(2) <= 1.0;
    let away = if y > 0.0 {
        // In units of b: g falls from above 0 at low to below 0 at high.
        let (u, v, r) = (x / b, y / b, (a / b).powi(2));
        let ratio = a / b;
        let g = |t: f64| (ratio * u / (t + r)).powi(2) + (v / (t + 1.0)).powi(2) - 1.0;
        let (mut low, mut high) = (v - 1.0, (ratio * u).hypot(v) - 1.0);
        for _ in 0..200 {
            let middle = 0.5 * (low + high);
            if middle <= low || middle >= high {
                break;
            }
            let end = if g(middle) > 0.0 { &mut low } else { &mut high };
            *end = middle;
        }
        let t = 0.5 * (low + high);
        b * (u * r / (t + r) - u).hypot(v / (t + 1.0) - v)
    } else if a > b && x < (a * a - b * b) / a {
        // On the long axis between the centres of curvature the nearest points are off it.
        let foot = a * a * x / (a * a - b * b);
        (foot - x).hypot(b * (1.0 - (foot / a).powi(2)).max(0.0).sqrt())
    } else {
        (x - a).abs()
    };
    if inside { away } else { -away }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn distances_are_those_of_the_densely_sampled_line() {
        for axes in [[2.0, 1.0], [1.0, 2.0], [1.0, 1.0], [0.105, 0.095]] {
            let near = [[0.0, 0.0], [0.3, 0.4], [1.0, 0.0], [0.0, 1.0]];
            let far = [[1.9, 0.1], [-3.0, 2.0], [0.0, -5.0]];
            for at in near.into_iter().chain(far) {
                let x = [0, 1].map(|k: usize| at[k] * axes[k]);
                let sampled = (0..200_000)
                    .map(|k| f64::from(k) * std::f64::consts::TAU / 200_000.0)
                    .map(|s| (axes[0] * s.cos() - x[0]).hypot(axes[1] * s.sin() - x[1]))
                    .fold(f64::INFINITY, f64::min);
                let found = depth(axes, x);
                let error = (found.abs() - sampled).abs();
                assert!(error < 1e-7, "{axes:?} {x:?}: {found} {sampled}");
                assert_eq!(found >= 0.0, at[0].hypot(at[1]) <= 1.0);
            }
        }
    }
}
