//! The level of the surface of a bed.

use crate::grains::GrainSystem;

/// Points along and across a mean radius.
const POINTS_PER_RADIUS: f64 = 4.0;

/// Mean height (m) of the top of a bed over a strip of a box along x or y: the upper surface of the grains, and the floor
/// between them. It follows every motion of the uppermost grains without a jump.
pub fn level(
    grains: &GrainSystem,
    [low, high]: [[f64; 3]; 2],
    axis: usize,
    [from, to]: [f64; 2],
) -> Option<f64> {
    let all = &grains.grains;
    let radius = all.radius.iter().sum::<f64>() / all.len() as f64;
    let (mut first, mut last) = ([low[0], low[1]], [high[0], high[1]]);
    first[axis] = from.max(low[axis]);
    last[axis] = to.min(high[axis]);
    let length = |k: usize| last[k] - first[k];
    if length(0).min(length(1)) <= 0.0 {
        return None;
    }
    let counts = [0, 1].map(|k| ((POINTS_PER_RADIUS * length(k) / radius).ceil() as usize).max(1));
    let steps = [0, 1].map(|k| length(k) / counts[k] as f64);
    let place = |k: usize, n: usize| first[k] + (n as f64 + 0.5) * steps[k];
    let mut heights = vec![low[2]; counts[0] * counts[1]];
    for (x, r) in all.position.iter().zip(&all.radius) {
        let under = |k: usize| {
            let begin = ((x[k] - r - first[k]) / steps[k] - 0.5).ceil().max(0.0) as usize;
            let end = ((x[k] + r - first[k]) / steps[k] + 0.5).max(0.0) as usize;
            begin..end.min(counts[k])
        };
        for i in under(0) {
            for j in under(1) {
                let off = (place(0, i) - x[0]).powi(2) + (place(1, j) - x[1]).powi(2);
                if off <= r * r {
                    let height = &mut heights[i * counts[1] + j];
                    *height = height.max(x[2] + (r * r - off).sqrt());
                }
            }
        }
    }
    Some(heights.iter().sum::<f64>() / heights.len() as f64)
}

#[cfg(test)]
mod tests {
    use std::f64::consts::PI;

    use crate::grains::{Grain, LinearElastic, Setup};

    use super::*;

    /// A hemisphere on a floor stands out by 2/3 π R³ over the area, at any depth.
    #[test]
    fn the_mean_height_of_a_ball_is_that_of_its_upper_half() {
        let (radius, depth) = (0.5, 0.7);
        let ball = Grain::new([1.0, 1.0, depth], radius, 2600.0);
        let setup = Setup::new(vec![ball], LinearElastic::new(1e6, 0.5, 0.5));
        let grains = GrainSystem::new(setup).expect("a grain");
        let room = [[0.0; 3], [2.0, 2.0, 2.0]];
        let whole = level(&grains, room, 0, [0.0, 2.0]).expect("a level");
        let disc = PI * radius * radius;
        let wanted = (disc * depth + 2.0 / 3.0 * PI * radius.powi(3)) / 4.0;
        // A disc of n points is counted to within its rim, of 2πR/step points.
        let step = radius / POINTS_PER_RADIUS;
        let bound = 2.0 * PI * radius * step * depth / 4.0;
        assert!(
            (whole - wanted).abs() < bound,
            "{whole} m, wanted {wanted} ± {bound} m"
        );
        assert_eq!(level(&grains, room, 0, [0.0, 0.2]), Some(0.0));
        assert_eq!(level(&grains, room, 0, [3.0, 4.0]), None);
    }
}
