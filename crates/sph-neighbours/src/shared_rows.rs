//! Rows of systems that are divided between ranks.

use std::sync::Arc;

use rayon::prelude::*;
use sph_core::Vect;

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
