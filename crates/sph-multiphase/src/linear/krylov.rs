//! Common parts of the iterative solvers.

use sph_core::Vect;

use crate::linear::{Operator, Report, SolveError};

/// When an iteration ends.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tolerance {
    /// Target of the relative residual |b − A x| / |b|.
    pub residual: f64,
    /// Iterations allowed.
    pub iterations: usize,
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
