//! Communication with other ranks that hold particles of the same flow.

use sph_core::{AnyField, StepError, Store, Vect};

/// The ranks between which a flow is divided, as work sees them that needs more than the particles at hand. All ranks call the
/// same methods in the same order.
pub trait Communicator<const D: usize>: Send + Sync {
    /// Marks of own particles; the others are copies.
    fn own(&self, free: &Store<D>) -> Vec<bool>;

    /// Marks of particles that need no sum over neighbours here, because their owner sends it; `None` if all need
    /// theirs.
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
    fn update_ghosts(&self, free: &mut Store<D>, columns: &[AnyField]) -> Result<(), StepError>;

    /// Begins a solve, in which no rank may fail: [`mirror`](Self::mirror), [`most`](Self::most) and [`add`](Self::add)
    /// return no error.
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
