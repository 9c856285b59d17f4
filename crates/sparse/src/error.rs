//! Errors of solves, with their reasons.

use thiserror::Error;

/// A system that has no factor, or no solution within the iterations allowed.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum SparseError {
    /// There is not enough memory for the factor.
    #[error("not enough memory to factorise {unknowns} unknowns; conjugate gradients need less")]
    NoMemory {
        /// Size of the system.
        unknowns: usize,
    },
    /// The matrix is not positive definite.
    #[error("the matrix of {unknowns} unknowns is not positive definite: row {row}")]
    NotPositive {
        /// The row whose pivot is not positive, in the order of elimination and counted from 1.
        row: usize,
        /// Size of the system.
        unknowns: usize,
    },
    /// Conjugate gradients did not end.
    #[error("the residual is {residual:e} of the right side after {iterations} iterations")]
    NotConverged {
        /// Relative to the right side.
        residual: f64,
        /// Allowed.
        iterations: usize,
    },
}
