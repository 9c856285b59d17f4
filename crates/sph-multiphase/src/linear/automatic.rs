//! The choice between the solvers: iterations first, a factorisation where they take too long.

use sph_core::plugin;

use crate::linear::conjugate_gradient::{ITERATIONS, iterate};
use crate::linear::{
    Cholesky, Diagonal, LinearSolver, LinearSolverEntry, LinearSystem, Memory, Operator,
    Preconditioner, Report, SolveError, SolveResult, Tolerance,
};

/// Iterates, and factorises where that takes too long:
///
/// * conjugate gradients with `jacobi` where the stiffness (largest Σ|a_ij| over what is left of the diagonal, about 2νΔt/δr² at
///   h = 2δr) is below 5, else with `incomplete-diagonal`; where components mix, 25 iterations with `jacobi` and, if these were too
///   few, more with `incomplete-cholesky`, whose factors cost as much as ten iterations;
/// * in 2D with up to 200 000 particles N, after √N iterations of the last one (2√N where components mix): `cholesky`. On two threads a
///   factorisation is done in the time of about so many, and no system takes more than two to three times the time of the better one.
///
/// Nothing is remembered of the solves before, so that a resumed run takes the same ones. Measured in docs/validation/implicit.md, beds
/// in docs/performance.md.
///
/// ```toml
/// [linear-solver.automatic]
/// tolerance = 1e-8
/// ```
#[plugin(LinearSolverEntry [2 => Automatic<2>, 3 => Automatic<3>], "automatic",
    "conjugate gradients, and in 2D Cholesky for the systems for which they take too long",
    source: "docs/validation/implicit.md")]
#[schemars(rename = "Automatic")]
pub struct Automatic<const D: usize> {
    /// Relative residual |b − A x| / |b| of the iterative solvers.
    #[parameter(default: 1e-8, unit: "1", above: 0.0, max: 0.1, source: "ours")]
    pub tolerance: f64,
    #[serde(skip)]
    direct: Cholesky,
    #[serde(skip)]
    memory: Memory<D>,
}

impl<const D: usize> Automatic<D> {
    /// With another tolerance of the iterative solvers.
    pub fn to(tolerance: f64) -> Self {
        Automatic {
            tolerance,
            ..Automatic::default()
        }
    }
}

/// Stiffness up to which the diagonal alone preconditions.
const MILD: f64 = 5.0;
/// Iterations after which factors of blocks are worth their making.
const BLOCK_PATIENCE: usize = 25;
/// Particles up to which factorising is tried.
const DIRECT_ROWS: usize = 200_000;

/// Iterations in whose time a factorisation is done; `None` where it is not tried.
fn iteration_limit<const D: usize>(rows: usize, mixed: bool) -> Option<usize> {
    let root = (rows as f64).sqrt().ceil() as usize;
    let most = if mixed { 2 * root } else { root };
    (D == 2 && rows <= DIRECT_ROWS).then_some(most)
}

/// True if the diagonal alone preconditions.
fn mild<const D: usize>(operator: &dyn Operator<D>) -> bool {
    operator.stiffness().is_some_and(|ratio| ratio < MILD)
}

impl<const D: usize> LinearSolver<D> for Automatic<D> {
    fn needs_entries(&self, operator: &dyn Operator<D>) -> bool {
        matches!(operator.diagonal(), Some(Diagonal::Scalar(_))) && !mild(operator)
    }

    fn solve_to(&mut self, (operator, right, x): LinearSystem<'_, D>, enough: f64) -> SolveResult {
        let within = |iterations| Tolerance::new(self.tolerance.max(enough), iterations);
        let Some(diagonal) = operator.diagonal() else {
            let (none, system) = (Preconditioner::None, (operator, right, x));
            return iterate(none, within(ITERATIONS), &mut self.memory, system);
        };
        let mixed = matches!(diagonal, Diagonal::Block(_));
        let stages = match (mild(operator), mixed) {
            (true, _) => &[Preconditioner::Jacobi][..],
            (false, false) => &[Preconditioner::IncompleteDiagonal],
            (false, true) => &[Preconditioner::Jacobi, Preconditioner::IncompleteCholesky],
        };
        // Factors are of whole matrices.
        let whole = operator.is_whole();
        let patience = iteration_limit::<D>(operator.rows(), mixed).filter(|_| whole);
        let mut spent = 0;
        for (k, &preconditioner) in stages.iter().enumerate() {
            let last = k + 1 == stages.len();
            let iterations = match last {
                false => BLOCK_PATIENCE,
                true => patience.unwrap_or(ITERATIONS),
            };
            // Each stage starts from the result of the one before.
            let system = (operator, right, &mut *x);
            let memory = &mut self.memory;
            match iterate(preconditioner, within(iterations), memory, system) {
                Err(SolveError::NotConverged { .. } | SolveError::NotPositive { .. })
                    if !last || patience.is_some() =>
                {
                    spent += iterations;
                }
                solved => {
                    return solved.map(|report| Report {
                        iterations: report.iterations + spent,
                        ..report
                    });
                }
            }
        }
        let report = self.direct.solve(operator, right, x)?;
        Ok(Report {
            iterations: spent,
            ..report
        })
    }
}
