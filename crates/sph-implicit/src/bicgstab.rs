//! Stabilised bi-conjugate gradients.

use schemars::JsonSchema;
use serde::Deserialize;
use sph_core::{Vect, register};

use crate::krylov::{Tolerance, Watch, residual};
use crate::vector::{add, dot, norm};
use crate::{LinearSolver, LinearSolverEntry, Matrix, Preconditioner, Report, SolveError};

/// BiCGSTAB (van der Vorst 1992), which needs no symmetry: what the thesis solves with. Two products
/// per iteration; for these matrices conjugate gradients are faster.
///
/// ```toml
/// [linear-solver.bicgstab]
/// ```
#[derive(Clone, Copy, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Bicgstab {
    /// What shortens the iteration.
    #[schemars(extend("source" = "Ghaïtanellis 2017, §5.1.1: jacobi"))]
    pub preconditioner: Preconditioner,
    /// Relative residual |b − A x| / |b| at which it ends.
    #[schemars(
        range(max = 0.1),
        extend("exclusiveMinimum" = 0.0, "unit" = "1", "source" = "ours")
    )]
    pub tolerance: f64,
    /// Iterations after which it gives up; the step is then tried again with half its length.
    #[schemars(range(min = 1), extend("unit" = "1", "source" = "ours"))]
    pub iterations: usize,
}

impl Default for Bicgstab {
    fn default() -> Self {
        Bicgstab {
            preconditioner: Preconditioner::Jacobi,
            tolerance: 1e-8,
            iterations: 2000,
        }
    }
}

const METHOD: &str = "BiCGSTAB";

impl<const D: usize> LinearSolver<D> for Bicgstab {
    fn solve(
        &mut self,
        matrix: &Matrix<D>,
        right: &[Vect<D>],
        x: &mut [Vect<D>],
    ) -> Result<Report, SolveError> {
        let tolerance = Tolerance {
            residual: self.tolerance,
            iterations: self.iterations,
        };
        let mut watch = Watch::new(METHOD, tolerance, right)?;
        let mut r = residual(matrix, right, x);
        if let Some(residual) = watch.reached(norm(&r))? {
            return Ok(watch.report(residual, size_of_val(&r[..])));
        }
        let precondition = self.preconditioner.bind(matrix, METHOD)?;
        let bytes = 7 * size_of_val(&r[..]) + precondition.bytes();
        let zeros = || vec![Vect::<D>::zeros(); right.len()];
        let shadow = r.clone();
        let (mut p, mut v, mut y, mut z, mut t) = (zeros(), zeros(), zeros(), zeros(), zeros());
        let (mut rho, mut alpha, mut omega) = (1.0, 1.0, 1.0);
        loop {
            let next = dot(&shadow, &r);
            if next == 0.0 || omega == 0.0 {
                return Err(watch.not_positive());
            }
            let beta = next / rho * (alpha / omega);
            rho = next;
            for ((p, r), v) in p.iter_mut().zip(&r).zip(&v) {
                *p = r + (*p - v * omega) * beta;
            }
            precondition.apply(&p, &mut y);
            matrix.multiply(&y, &mut v);
            alpha = rho / dot(&shadow, &v);
            add(&mut r, -alpha, &v);
            add(x, alpha, &y);
            precondition.apply(&r, &mut z);
            matrix.multiply(&z, &mut t);
            let squared = dot(&t, &t);
            omega = if squared > 0.0 {
                dot(&t, &r) / squared
            } else {
                0.0
            };
            add(x, omega, &z);
            add(&mut r, -omega, &t);
            if let Some(residual) = watch.reached(norm(&r))? {
                return Ok(watch.report(residual, bytes));
            }
        }
    }
}

register!(
    LinearSolverEntry [2, 3],
    Bicgstab,
    "bicgstab",
    "stabilised bi-conjugate gradients, for comparison with the thesis",
    "van der Vorst 1992; Ghaïtanellis 2017, §5.1.1"
);
