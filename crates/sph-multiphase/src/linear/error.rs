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
        method: String,
        /// Asked for.
        wanted: f64,
        /// Done.
        iterations: usize,
        /// Relative residuals, from the first.
        history: Vec<f64>,
    },
    /// A pivot or a curvature is not positive.
    #[error("{method}: the matrix is not positive definite at row {row}")]
    NotPositive {
        /// The solver.
        method: String,
        /// Row of the fault.
        row: usize,
    },
    /// A number is not finite.
    #[error("{method}: {what} of the system is not finite")]
    NotFinite {
        /// The solver.
        method: String,
        /// Matrix or right-hand side.
        what: &'static str,
    },
    /// Entries that the method needs are not there.
    #[error("{method} needs all entries of the matrix, and this operator only multiplies")]
    NotWhole {
        /// The solver.
        method: String,
    },
    /// The factorisation has no room.
    #[error("{method}: no memory for the factorisation of {rows} rows")]
    NoMemory {
        /// The solver.
        method: String,
        /// Size of the system.
        rows: usize,
    },
}

fn history_text(history: &[f64]) -> String {
    let step = history.len().div_ceil(8).max(1);
    let mut shown: Vec<String> = history
        .iter()
        .step_by(step)
        .map(|r| format!("{r:.1e}"))
        .collect();
    if let Some(last) = history.last() {
        shown.push(format!("{last:.1e} at the end"));
    }
    shown.join(", ")
}
