//! Chains of corners and polygons.

use scene_text::Problems;

use crate::checks::dimension::Dimension;
use crate::geometry::polygon::crossing;
use crate::geometry::vector::{array, point};
use crate::{Polygon, Shape};

/// The corners, if each has two coordinates and differs from the one before.
pub(crate) fn chain(
    points: &[Vec<f64>],
    closed: bool,
    path: &str,
    found: &mut Problems,
) -> Option<Vec<[f64; 2]>> {
    let before = found.0.len();
    for (k, p) in points.iter().enumerate() {
        let place = format!("{path}[{k}]");
        if !Dimension(2).vector(p, &place, found) {
            break;
        }
        let previous = match k {
            0 if closed => points.last(),
            0 => None,
            k => points.get(k - 1),
        };
        if previous == Some(p) {
            let message = format!("the corner {} stands there twice in a row", point(p));
            found.add(place, message);
            break;
        }
    }
    (found.0.len() == before).then(|| points.iter().map(|p| array(p)).collect())
}

/// No edge meets another.
pub(crate) fn crossed(
    edges: &[([f64; 2], [f64; 2])],
    closed: bool,
    path: &str,
    found: &mut Problems,
) {
    if let Some((first, second, place)) = crossing(edges, closed) {
        let message = format!(
            "the edges from corners {first} and {second}, counted from 0, meet at {}",
            point(&place)
        );
        found.add(path, message);
    }
}

/// A polygon has an area and does not cross itself.
pub(crate) fn polygon(points: &[Vec<f64>], path: &str, found: &mut Problems) {
    let Some(corners) = chain(points, true, path, found) else {
        return;
    };
    let polygon = Polygon::new(corners);
    let (lo, hi) = Shape::<2>::Polygon(polygon.clone()).bounds();
    let size = (hi[0] - lo[0]).max(hi[1] - lo[1]);
    let flat = (hi[0] - lo[0]).min(hi[1] - lo[1]) <= 1e-12 * size;
    let edges: Vec<_> = polygon.edges().collect();
    if flat {
        found.add(path, "the polygon has no area");
    } else if crossing(&edges, true).is_some() {
        crossed(&edges, true, path, found);
    } else if polygon.area().abs() <= 1e-12 * size * size {
        found.add(path, "the polygon has no area");
    }
}
