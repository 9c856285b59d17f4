//! The trait of linear solvers.

use sph_core::{Vect, contract};

use crate::linear::{Operator, SolveError};

/// Effort of a solve.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Report {
    /// The solver.
    pub method: &'static str,
    /// Iterations; for a factorisation those that were spent before it was tried, 0 if it was the first.
    pub iterations: usize,
    /// |b − A x| / |b|.
    pub residual: f64,
    /// Most bytes held at a time besides matrix, right-hand side and solution: factors, preconditioner, search directions.
    pub bytes: usize,
}

/// A, b and x of A x = b; b and x have a value for every row, x that of the start.
pub type LinearSystem<'s, const D: usize> = (&'s dyn Operator<D>, &'s [Vect<D>], &'s mut [Vect<D>]);

/// Effort of a solve, or why there is no solution.
pub type SolveResult = Result<Report, SolveError>;

/// Solves symmetric positive definite systems.
pub trait LinearSolver<const D: usize>: Send {
    /// Solves a system within an outer iteration: a relative residual of `enough` will do, where stopping early saves
    /// work.
    ///
    /// # Errors
    /// If the residual is above the tolerance; x is then no better than a start for another solver.
    fn solve_to(&mut self, system: LinearSystem<'_, D>, enough: f64) -> SolveResult;

    /// Solves A x = b, starting from x.
    ///
    /// # Errors
    /// As [`solve_to`](LinearSolver::solve_to).
    fn solve(
        &mut self,
        operator: &dyn Operator<D>,
        right: &[Vect<D>],
        x: &mut [Vect<D>],
    ) -> SolveResult {
        self.solve_to((operator, right, x), 0.0)
    }

    /// True if it needs the entries of an operator in any case, and not for products and the diagonal alone.
    fn needs_entries(&self, _operator: &dyn Operator<D>) -> bool {
        true
    }
}

contract!(
    /// A linear solver that a scene may name.
    pub LinearSolverEntry, "linear-solver", One, "the solver of sparse systems", LinearSolver<D>,
    .by_default("automatic").idle(
        "nothing in this scene is solved for: take this table out, or add `[implicit-viscosity.backward-euler]`"
    )
);
