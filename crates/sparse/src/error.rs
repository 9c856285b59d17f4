//! Errors of solves, with their reasons.

use thiserror::Error;

/// A system that has no factor, or no solution within the iterations allowed.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum SparseError {
    /// There is not enough memory for the factor of a system of this size.
    #[error("not enough memory to factorise {0} unknowns; conjugate gradients need less")]
    NoMemory(usize),
    /// The matrix is not positive definite: the row whose pivot is not positive, in the order of elimination and
    /// counted from 1, and the size of the system.
    #[error("the matrix of {1} unknowns is not positive definite: row {0}")]
    NotPositive(usize, usize),
    /// Conjugate gradients did not end: the residual relative to the right side, and the iterations allowed.
    #[error("the residual is {0:e} of the right side after {1} iterations")]
    NotConverged(f64, usize),
}
