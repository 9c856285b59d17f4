//! Rows of systems, and elements of walls, that are divided between ranks.

use std::sync::Arc;

use rayon::prelude::*;
use sph_core::{FieldError, Vect, fields};

use crate::{Team, World};

/// Rows of a system that are divided between ranks: copies of others' rows are here as well, and follow their owners in every product.
pub struct SharedRows<const D: usize> {
    /// The others.
    pub team: Arc<dyn Team<D>>,
    /// Which rows are one's own.
    pub own: Vec<bool>,
}

/// Rows of a sum in one go.
const BATCH: usize = 4096;

impl<const D: usize> SharedRows<D> {
    /// Those of a world; none where all rows are here.
    pub fn of(world: &World<D>) -> Option<Self> {
        world.team.as_ref().map(|team| SharedRows {
            team: team.clone(),
            own: team.own(&world.free),
        })
    }

    /// Σ x·y over the rows of all ranks; the same bits for all of them.
    pub fn inner<const C: usize>(&self, x: &[Vect<C>], y: &[Vect<C>]) -> f64 {
        self.team.add(inner(x, y, &self.own))
    }

    /// Whether it holds on all ranks.
    pub fn all(&self, holds: bool) -> bool {
        self.team.most(f64::from(u8::from(!holds))) == 0.0
    }
}

/// Σ x·y over the rows that are one's own, in an order that does not depend on threads.
pub fn inner<const C: usize>(x: &[Vect<C>], y: &[Vect<C>], own: &[bool]) -> f64 {
    let batches = x.par_chunks(BATCH).zip(y.par_chunks(BATCH));
    let parts = batches.zip(own.par_chunks(BATCH)).map(|((x, y), own)| {
        let rows = x.iter().zip(y).zip(own).filter(|(_, own)| **own);
        rows.map(|((x, y), _)| x.dot(y)).sum::<f64>()
    });
    let parts: Vec<f64> = parts.collect();
    parts.iter().sum()
}

/// Which elements of walls are one's own: those whose mean over the fluid has the particle of the lowest number at home here.
/// All others in the mean are then here too, or copies of them.
pub struct SharedElements<'a, const D: usize> {
    world: &'a World<D>,
    own: Vec<bool>,
    identity: &'a [u32],
    position: &'a [Vect<D>],
}

impl<'a, const D: usize> SharedElements<'a, D> {
    /// Those of a world with lists; none where all particles are here.
    ///
    /// # Errors
    /// If a column is missing.
    pub fn of(world: &'a World<D>) -> Result<Option<Self>, FieldError> {
        let Some(team) = &world.team else {
            return Ok(None);
        };
        Ok(Some(SharedElements {
            world,
            own: team.own(&world.free),
            identity: world.free.get(fields::IDENTITY)?,
            position: world.free.get(fields::POSITION)?,
        }))
    }

    /// Whether an element is one's own; nobody's, where no particle is within a support of it.
    pub fn own(&self, element: usize) -> bool {
        let centre = &self.world.walls.elements.centre[element];
        self.own_around(centre, self.world.lists.of_elements.candidates(element))
    }

    /// The same of a place on a wall, with all particles that may be within a support of it.
    pub fn own_around(&self, place: &Vect<D>, candidates: &[u32]) -> bool {
        let world = self.world;
        let support = world.kernel.support_radius().powi(2);
        let near = |j: &usize| {
            let apart = world.domain.nearest_image(self.position[*j] - place);
            apart.norm_squared() < support
        };
        let first = candidates.iter().map(|j| *j as usize).filter(near);
        first
            .min_by_key(|j| self.identity[*j])
            .is_some_and(|j| self.own[j])
    }
}
