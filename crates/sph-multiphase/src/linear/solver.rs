//! The trait of linear solvers, and common parts of the iterative ones.

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

/// When an iteration ends.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tolerance {
    /// Target of the relative residual |b − A x| / |b|.
    pub residual: f64,
    /// Iterations allowed.
    pub iterations: usize,
}

impl Tolerance {
    /// Of a residual and a number of iterations.
    pub fn new(residual: f64, iterations: usize) -> Self {
        Tolerance {
            residual,
            iterations,
        }
    }
}

pub(crate) struct SolveMonitor<'s> {
    method: &'static str,
    tolerance: Tolerance,
    scale: f64,
    history: &'s mut Vec<f64>,
}

impl<'s> SolveMonitor<'s> {
    /// # Errors
    /// If the right-hand side is not finite.
    pub fn new<const D: usize>(
        method: &'static str,
        tolerance: Tolerance,
        operator: &dyn Operator<D>,
        right: &[Vect<D>],
        history: &'s mut Vec<f64>,
    ) -> Result<Self, SolveError> {
        let scale = operator.norm(right);
        history.clear();
        match scale.is_finite() {
            true => Ok(SolveMonitor {
                method,
                tolerance,
                scale,
                history,
            }),
            false => Err(SolveError::NotFinite(method, "the right-hand side")),
        }
    }

    /// Notes a residual; its relative size if that is small enough.
    ///
    /// # Errors
    /// If it is not finite, or all iterations are spent.
    pub fn reached(&mut self, residual: f64) -> Result<Option<f64>, SolveError> {
        let relative = match self.scale > 0.0 {
            true => residual / self.scale,
            false => residual,
        };
        self.history.push(relative);
        if !relative.is_finite() {
            return Err(SolveError::NotFinite(self.method, "the residual"));
        }
        if relative <= self.tolerance.residual {
            return Ok(Some(relative));
        }
        match self.iterations() >= self.tolerance.iterations {
            true => Err(SolveError::NotConverged {
                method: self.method,
                wanted: self.tolerance.residual,
                iterations: self.iterations(),
                history: self.history.clone(),
            }),
            false => Ok(None),
        }
    }

    /// Iterations so far.
    pub fn iterations(&self) -> usize {
        self.history.len().saturating_sub(1)
    }

    /// Effort of the solve.
    pub fn report(&self, residual: f64, bytes: usize) -> Report {
        Report {
            method: self.method,
            iterations: self.iterations(),
            residual,
            bytes,
        }
    }

    /// A curvature that is not positive.
    pub fn not_positive(&self) -> SolveError {
        SolveError::NotPositive(self.method, 0)
    }
}
