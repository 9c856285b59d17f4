//! The column of distances from walls.

use rayon::prelude::*;
use sph_core::{Access, Declares, Stage, StepError, Vect, fields};
use sph_neighbours::World;

use super::tree::ElementTree;
use crate::columns::WALL_DISTANCE;

/// [`WALL_DISTANCE`]: the true distance from the nearest of some walls, by their elements; `within` where all are farther.
pub struct WallDistance<const D: usize> {
    /// Which walls count; all, if empty.
    walls: Vec<String>,
    /// Beyond it nobody asks, m.
    within: f64,
    tree: ElementTree<D>,
    /// The places of the elements that it is of.
    built_for: Option<Vec<Vect<D>>>,
}

impl<const D: usize> WallDistance<D> {
    /// Of walls by their names, all if there are none, as far as `within`, m.
    pub fn new(walls: &[String], within: f64) -> Self {
        WallDistance {
            walls: walls.to_vec(),
            within,
            tree: ElementTree::default(),
            built_for: None,
        }
    }
}

impl<const D: usize> Declares for WallDistance<D> {
    fn name(&self) -> String {
        "wall distance".into()
    }
    fn access(&self) -> Access {
        Access::none().here(fields::POSITION).writes(WALL_DISTANCE)
    }
}

impl<const D: usize> Stage<World<D>> for WallDistance<D> {
    fn run(&mut self, world: &mut World<D>) -> Result<(), StepError> {
        let mut distance = world.free.take(WALL_DISTANCE)?;
        let walls = &world.walls;
        if self.built_for.as_ref() != Some(&walls.points.position) {
            let name = |s: usize| &walls.names[walls.elements.wall[s] as usize];
            let counts = |s: usize| self.walls.is_empty() || self.walls.contains(name(s));
            self.tree = ElementTree::of(walls, &world.domain, counts);
            self.built_for = Some(walls.points.position.clone());
        }
        let (tree, within) = (&self.tree, self.within);
        let positions = world.free.get(fields::POSITION)?;
        let all = distance.par_iter_mut().zip(positions).with_min_len(256);
        all.for_each(|(d, x)| *d = tree.nearest(x, within).map_or(within, |n| n.0));
        Ok(world.free.put(WALL_DISTANCE, distance)?)
    }
}
