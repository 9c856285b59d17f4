//! Places of dummy particles behind surfaces.

use rayon::prelude::*;
use sph_core::Vect;

use crate::PeriodicBox;
use crate::geometry::vector::bounds;
use crate::geometry::walls::wall_mesh::WallMesh;

/// A place nearer to the fluid's side than this share of the spacing is left out.
const TOO_NEAR: f64 = 0.25;

/// Nodes of the cubic lattice of half spacings, counted from the lower corner of the box around all
/// walls, that are outside the fluid and within the support of a wall.
///
/// Faces along the axes at whole spacings get rows at ½, 1½, … spacings; slanted and curved ones
/// get steps.
pub(crate) fn layers<M: WallMesh<3>>(
    walls: &M,
    domain: &PeriodicBox<3>,
    spacing: f64,
    support: f64,
) -> Vec<(usize, Vect<3>)> {
    let [low, high] = bounds(walls.nodes().iter().map(|n| n.position));
    let axis = |k: usize| -> Vec<f64> {
        if domain.periodic[k] {
            let period = domain.upper[k] - domain.lower[k];
            let count = (period / spacing).round().max(1.0);
            let node = |i: usize| domain.lower[k] + (i as f64 + 0.5) * (period / count);
            return (0..count as usize).map(node).collect();
        }
        let beyond = (support / spacing).ceil();
        let count = ((high[k] - low[k]) / spacing).ceil() + 2.0 * beyond;
        let node = |i: usize| low[k] + (i as f64 + 0.5 - beyond) * spacing;
        (0..count as usize).map(node).collect()
    };
    let [xs, ys, zs] = [axis(0), axis(1), axis(2)];
    let column = |(x, y): (f64, f64)| -> Vec<(usize, Vect<3>)> {
        let place = |z: &f64| {
            let place = Vect::from([x, y, *z]);
            let (distance, wall) = walls.nearest(&place, support)?;
            let kept = distance >= TOO_NEAR * spacing && !walls.contains(&place);
            kept.then_some((wall, place))
        };
        zs.iter().filter_map(place).collect()
    };
    let columns: Vec<_> = xs
        .iter()
        .flat_map(|x| ys.iter().map(|y| (*x, *y)))
        .collect();
    columns.into_par_iter().flat_map_iter(column).collect()
}
