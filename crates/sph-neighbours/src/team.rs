//! Others who hold particles of the same flow.

use std::sync::Arc;

use rayon::prelude::*;
use sph_core::{AnyField, StepError, Store, Vect};

use crate::World;

/// The ranks between which a flow is divided, as work sees them that needs more than the particles at hand. All ranks call the
/// same methods in the same order.
pub trait Team<const D: usize>: Send + Sync {
    /// Whether each particle is one's own, and not a copy of another's.
    fn own(&self, free: &Store<D>) -> Vec<bool>;

    /// Whether nobody asks for what is summed over a particle's neighbours: others tell; `None` if all are asked for.
    fn idle(&self, free: &Store<D>) -> Option<Vec<bool>>;

    /// Replaces each value by the largest of all ranks.
    ///
    /// # Errors
    /// If another rank has failed, or messages do, as everywhere below.
    fn largest(&self, values: &mut [f64]) -> Result<(), StepError>;

    /// Replaces each number by its sum over all ranks, which wraps around.
    ///
    /// # Errors
    /// As [`largest`](Self::largest).
    fn total(&self, numbers: &mut [u64]) -> Result<(), StepError>;

    /// The numbers of all ranks, one rank's behind the other's.
    ///
    /// # Errors
    /// As [`largest`](Self::largest).
    fn gather(&self, own: &[u64]) -> Result<Vec<u64>, StepError>;

    /// Gives copies the values of their owners in these columns.
    ///
    /// # Errors
    /// As [`largest`](Self::largest).
    fn tell(&self, free: &mut Store<D>, columns: &[AnyField]) -> Result<(), StepError>;

    /// Begins a solve, in which nobody may fail: [`mirror`](Self::mirror), [`most`](Self::most) and [`add`](Self::add) return nothing that could tell.
    ///
    /// # Errors
    /// As [`largest`](Self::largest).
    fn begin_solve(&self) -> Result<(), StepError>;

    /// Gives copies the values of their owners in a vector of a solve.
    fn mirror(&self, values: &mut [Vect<D>]);

    /// The same of a vector with one number for each particle.
    fn mirror_scalars(&self, values: &mut [Vect<1>]);

    /// The largest value of all ranks, in a solve.
    fn most(&self, value: f64) -> f64;

    /// The sum of all ranks' parts, in the order of the ranks.
    fn add(&self, part: f64) -> f64;
}

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
