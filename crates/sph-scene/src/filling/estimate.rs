//! Counting particles before any memory is touched.

use crate::Region;

/// About how many particles [`fill`](crate::fill) will place, from the boxes around the bodies.
///
/// No lattice node is visited, so that a scene of 10¹² particles can be refused at once.
/// Regions that are cut out, and the corners beside a disc, count as if they were filled.
///
/// ```
/// use sph_scene::{Region, Shape, estimate};
///
/// let body = Region::whole(Shape::Cuboid { lo: [0.0; 3], hi: [1.0; 3] });
/// assert_eq!(estimate(&[body], 1e-4), 1e12);
/// ```
pub fn estimate<const D: usize>(bodies: &[Region<D>], spacing: f64) -> f64 {
    let along = |lo: f64, hi: f64| ((hi - lo) / spacing).round().max(1.0);
    let count = |region: &Region<D>| {
        let (lo, hi) = region.base.bounds();
        (0..D).map(|k| along(lo[k], hi[k])).product::<f64>()
    };
    bodies.iter().map(count).sum()
}
