//! The part of the plane in a picture.

use sph_core::{Corners, bounds};

use crate::drawing::draw_target::Spot;
use crate::drawing::ticks::widened;

/// Size of coordinates beyond which a difference might not be finite.
const SANE: f64 = 1e150;

/// The least box around some spots; none if there are none that are sane.
fn around(spots: impl Iterator<Item = Spot>) -> Option<Corners<2>> {
    let [lo, hi] = bounds(spots.filter(|spot| spot.iter().all(|x| x.abs() < SANE)));
    (lo[0] <= hi[0]).then_some([lo, hi])
}

fn grown([lo, hi]: Corners<2>, by: f64) -> Corners<2> {
    [lo.map(|x| x - by), hi.map(|x| x + by)]
}

fn largest_side([lo, hi]: Corners<2>) -> f64 {
    (hi[0] - lo[0]).max(hi[1] - lo[1])
}

/// The horizontal and vertical extent of particles of `diameter` and walls.
///
/// Where there are walls, particles that escaped from walls and from most of the particles by more than a quarter of their
/// extent do not shrink the rest of the picture.
pub(crate) fn window(
    points: impl Iterator<Item = Spot>,
    walls: impl Iterator<Item = Spot>,
    diameter: f64,
) -> [[f64; 2]; 2] {
    let points: Vec<Spot> = points.collect();
    let most = most(&points);
    let points = around(points.into_iter()).map(|points| grown(points, diameter / 2.0));
    let all = match (points, around(walls)) {
        (Some(points), Some(walls)) => {
            let near = bounds(walls.into_iter().chain(most.into_iter().flatten()));
            let [lo, hi] = grown(near, largest_side(near) / 4.0 + diameter);
            let within = points.map(|spot| [0, 1].map(|i| spot[i].clamp(lo[i], hi[i])));
            bounds(walls.into_iter().chain(within))
        }
        (Some(one), None) | (None, Some(one)) => one,
        (None, None) => [[0.0; 2], [1.0; 2]],
    };
    let [lo, hi] = grown(all, 0.02 * largest_side(all));
    [0, 1].map(|i| widened(lo[i], hi[i]))
}

/// Share of the particles at either end of an axis that are not counted among most of them.
const FEW: f64 = 0.005;

/// The extent of most particles; none if there are few.
fn most(points: &[Spot]) -> Option<Corners<2>> {
    let few = ((FEW * points.len() as f64) as usize).max(1);
    let range = |axis: usize| {
        let all = points.iter().map(|p| p[axis]).filter(|x| x.abs() < SANE);
        let mut all: Vec<f64> = all.collect();
        all.sort_unstable_by(f64::total_cmp);
        (all.len() > 2 * few).then(|| [all[few], all[all.len() - 1 - few]])
    };
    let (x, y) = (range(0)?, range(1)?);
    Some([[x[0], y[0]], [x[1], y[1]]])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_escaped_particle_does_not_shrink_the_tank() {
        let walls = [[0.0, 0.0], [1.0, 0.0]];
        let points = [[0.5, 0.5], [0.5, 1e6], [f64::NAN, 0.0]];
        let [x, y] = window(points.into_iter(), walls.into_iter(), 0.1);
        assert!(x[0] < 0.0 && x[0] > -0.1 && x[1] < 1.1, "{x:?}");
        assert!(y[1] < 0.5, "{y:?}");
    }

    #[test]
    fn a_column_on_a_floor_is_seen_to_its_top() {
        let walls = [[0.0, 0.0], [0.5, 0.0]];
        let row = |k: u32| (0..10).map(move |i| [0.05 * f64::from(i), 0.05 * f64::from(k)]);
        let escaped = std::iter::once([0.2, 1e6]);
        let points = (0..20).flat_map(row).chain(escaped);
        let [_, y] = window(points, walls.into_iter(), 0.05);
        assert!(y[1] > 0.97 && y[1] < 1.5, "{y:?}");
    }

    #[test]
    fn nothing_at_all_still_has_an_extent() {
        let none = || std::iter::empty();
        let [x, y] = window(none(), none(), 0.0);
        assert!(x[0] < x[1] && y[0] < y[1]);
        let one = [[3.0, 3.0]];
        let [x, _] = window(one.into_iter(), none(), 0.0);
        assert!(x[0] < 3.0 && x[1] > 3.0);
    }
}
