//! Errors of a solve.

use thiserror::Error;

/// A system that was not solved. There is never a silent result.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum SolveError {
    /// The residual is still too large.
    #[error(
        "{method} did not reach a relative residual of {wanted:e} in {iterations} iterations (residuals: {})",
        history_text(history)
    )]
    NotConverged {
        /// The solver.
        method: &'static str,
        /// Asked for.
        wanted: f64,
        /// Done.
        iterations: usize,
        /// Relative residuals, from the first.
        history: Vec<f64>,
    },
    /// A pivot or a curvature is not positive: the solver, and the row of the fault.
    #[error("{0}: the matrix is not positive definite at row {1}")]
    NotPositive(&'static str, usize),
    /// A number of the matrix or of a vector is not finite: the solver, and what that is of.
    #[error("{0}: {1} of the system is not finite")]
    NotFinite(&'static str, &'static str),
    /// Entries that the solver needs are not there.
    #[error("{0} needs all entries of the matrix, and this operator only multiplies")]
    NotWhole(&'static str),
    /// The factorisation has no room: the solver, and the rows of the system.
    #[error("{0}: no memory for the factorisation of {1} rows")]
    NoMemory(&'static str, usize),
}

fn history_text(history: &[f64]) -> String {
    let step = history.len().div_ceil(8).max(1);
    let each = history.iter().step_by(step).map(|r| format!("{r:.1e}"));
    let mut shown: Vec<_> = each.collect();
    if let Some(last) = history.last() {
        shown.push(format!("{last:.1e} at the end"));
    }
    shown.join(", ")
}
