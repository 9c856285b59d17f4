//! The choice between the solvers, by size and stiffness.

use schemars::JsonSchema;
use serde::Deserialize;
use sph_core::{Vect, register};

use crate::{
    Cholesky, ConjugateGradient, Entries, LinearSolver, LinearSolverEntry, Matrix, Preconditioner,
    Report, SolveError,
};

/// Looks at every matrix and takes what is fastest for its kind:
///
/// * stiffness (largest Σ|a_ij| over what is left of the diagonal, about 2νΔt/δr² at h = 2δr) below 5:
///   conjugate gradients with `jacobi`;
/// * in 2D with up to 200 000 particles and a stiffness above 2000, or above 20 000 where components
///   mix: `cholesky`;
/// * else conjugate gradients with `incomplete-diagonal`, or, where components mix, 25 iterations with `jacobi` and,
///   if these were too few, more with `incomplete-cholesky`, whose factors cost as much as ten iterations.
///
/// Measured in docs/validation/implicit.md, blocks with a pile of grains and with a bed under a dam break.
///
/// ```toml
/// [linear-solver.automatic]
/// tolerance = 1e-8
/// ```
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Automatic {
    /// Relative residual |b − A x| / |b| of the iterative solvers.
    #[schemars(
        range(max = 0.1),
        extend("exclusiveMinimum" = 0.0, "unit" = "1", "source" = "ours")
    )]
    pub tolerance: f64,
    #[serde(skip)]
    #[schemars(skip)]
    direct: Cholesky,
}

impl Automatic {
    /// With another tolerance of the iterative solvers.
    pub fn to(tolerance: f64) -> Self {
        Automatic {
            tolerance,
            ..Automatic::default()
        }
    }
}

impl Default for Automatic {
    fn default() -> Self {
        Automatic {
            tolerance: 1e-8,
            direct: Cholesky::default(),
        }
    }
}

/// Stiffness up to which the diagonal alone preconditions.
const MILD: f64 = 5.0;
/// Stiffness from which factorising pays, in 2D.
const STIFF: f64 = 2000.0;
/// The same for blocks, whose factors have four times the entries and eight times the work.
const STIFF_BLOCKS: f64 = 20_000.0;
/// Iterations after which factors are worth their making, for blocks.
const PATIENCE: usize = 25;
/// Particles up to which factorising is tried.
const DIRECT_ROWS: usize = 200_000;

impl<const D: usize> LinearSolver<D> for Automatic {
    fn solve(
        &mut self,
        matrix: &Matrix<D>,
        right: &[Vect<D>],
        x: &mut [Vect<D>],
    ) -> Result<Report, SolveError> {
        self.solve_roughly(matrix, right, x, 0.0)
    }

    fn solve_roughly(
        &mut self,
        matrix: &Matrix<D>,
        right: &[Vect<D>],
        x: &mut [Vect<D>],
        enough: f64,
    ) -> Result<Report, SolveError> {
        let stiffness = matrix.stiffness();
        let mixed = matches!(matrix.entries, Entries::Block(_));
        let stiff = if mixed { STIFF_BLOCKS } else { STIFF };
        if D == 2 && matrix.rows() <= DIRECT_ROWS && stiffness > stiff {
            return self.direct.solve(matrix, right, x);
        }
        let with = |preconditioner| ConjugateGradient {
            tolerance: self.tolerance,
            preconditioner,
            ..ConjugateGradient::default()
        };
        let mut iterate = |mut solver: ConjugateGradient| {
            LinearSolver::solve_roughly(&mut solver, matrix, right, x, enough)
        };
        if stiffness < MILD {
            return iterate(with(Preconditioner::Jacobi));
        }
        if !mixed {
            return iterate(with(Preconditioner::IncompleteDiagonal));
        }
        let first = iterate(ConjugateGradient {
            iterations: PATIENCE,
            ..with(Preconditioner::Jacobi)
        });
        match first {
            // What they reached is where the next one starts.
            Err(SolveError::NotConverged { .. }) => {
                let mut report = iterate(with(Preconditioner::IncompleteCholesky))?;
                report.iterations += PATIENCE;
                Ok(report)
            }
            other => other,
        }
    }
}

register!(
    LinearSolverEntry [2, 3],
    Automatic,
    "automatic",
    "Cholesky or conjugate gradients, by size and stiffness of every system",
    "docs/validation/implicit.md"
);
