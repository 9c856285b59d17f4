//! The column of distances from walls.

use rayon::prelude::*;
use sph_core::{Access, Declares, Stage, StepError, Vect, fields};
use sph_neighbours::World;

use super::tree::ElementTree;
use crate::columns::WALL_DISTANCE;

/// [`WALL_DISTANCE`]: the true distance from the nearest of some walls, by their elements; `within` where all are farther.
pub struct WallDistance<const D: usize> {
    /// Walls that count; all, if empty.
    walls: Vec<String>,
    /// Beyond it no value is needed, m.
    within: f64,
    /// With the places of the elements that it is of.
    tree: Option<(ElementTree<D>, Vec<Vect<D>>)>,
}

impl<const D: usize> WallDistance<D> {
    /// Of walls by their names, all if there are none, as far as `within`, m.
    pub fn new(walls: &[String], within: f64) -> Self {
        WallDistance {
            walls: walls.to_vec(),
            within,
            tree: None,
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
        let places = &walls.points.position;
        if self.tree.as_ref().is_none_or(|(_, of)| of != places) {
            let name = |s: usize| &walls.names[walls.elements.wall[s] as usize];
            let counts = |s: usize| self.walls.is_empty() || self.walls.contains(name(s));
            let tree = ElementTree::new(walls, &world.domain, counts);
            self.tree = Some((tree, places.clone()));
        }
        let within = self.within;
        let nearest = |x| {
            self.tree
                .as_ref()
                .and_then(|(tree, _)| tree.nearest(x, within))
        };
        let positions = world.free.get(fields::POSITION)?;
        let all = distance.par_iter_mut().zip(positions).with_min_len(256);
        all.for_each(|(d, x)| *d = nearest(x).map_or(within, |n| n.0));
        Ok(world.free.put(WALL_DISTANCE, distance)?)
    }
}
