//! Distance of particles from walls.

mod tree;

use rayon::prelude::*;
use sph_core::{Access, Stage, fields};
use sph_neighbours::{World, column_stage};

use crate::columns::WALL_DISTANCE;

pub(crate) use tree::KeptTree;

/// [`WALL_DISTANCE`]: the true distance from the nearest of the named walls, of all if none is named, by their elements;
/// `within`, m, where all are farther.
pub(crate) fn wall_distance<const D: usize>(
    named: Vec<String>,
    within: f64,
) -> impl Stage<World<D>> {
    let (name, access) = ("wall distance", Access::none().here(fields::POSITION));
    let mut tree = KeptTree::default();
    column_stage::<D, _>(name, access, WALL_DISTANCE, move |world, distance| {
        let walls = &world.walls;
        let name = |s: usize| &walls.names[walls.elements.wall[s] as usize];
        let tree = tree.updated(world, |s| named.is_empty() || named.contains(name(s)));
        let positions = world.free.get(fields::POSITION)?;
        let all = distance.par_iter_mut().zip(positions).with_min_len(256);
        all.for_each(|(d, x)| *d = tree.nearest(x, within).map_or(within, |n| n.0));
        Ok(())
    })
}
