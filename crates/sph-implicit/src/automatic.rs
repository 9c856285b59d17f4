//! The choice between the solvers, by size and stiffness.

use schemars::JsonSchema;
use serde::Deserialize;
use sph_core::{Vect, register};

use crate::{
    Cholesky, ConjugateGradient, LinearSolver, LinearSolverEntry, Matrix, Preconditioner, Report,
    SolveError,
};

/// Looks at every matrix and takes what is fastest for its kind:
///
/// * stiffness (largest Σ|a_ij| over what is left of the diagonal, about 2νΔt/δr² at h = 2δr) below 20:
///   conjugate gradients with `jacobi`;
/// * in 2D with up to 200 000 particles and a stiffness above 200: `cholesky`;
/// * else conjugate gradients with `incomplete-cholesky`.
///
/// Measured in docs/implicit.md.
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
    #[serde(skip)]
    #[schemars(skip)]
    last_was_direct: bool,
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
            last_was_direct: false,
        }
    }
}

/// Stiffness up to which the diagonal alone preconditions.
const MILD: f64 = 20.0;
/// Stiffness from which factorising pays, in 2D.
const STIFF: f64 = 200.0;
/// Particles up to which factorising is tried.
const DIRECT_ROWS: usize = 200_000;

impl<const D: usize> LinearSolver<D> for Automatic {
    fn solve(
        &mut self,
        matrix: &Matrix<D>,
        right: &[Vect<D>],
        x: &mut [Vect<D>],
    ) -> Result<Report, SolveError> {
        let stiffness = matrix.stiffness();
        self.last_was_direct = D == 2 && matrix.rows() <= DIRECT_ROWS && stiffness > STIFF;
        if self.last_was_direct {
            return self.direct.solve(matrix, right, x);
        }
        let mut iterative = ConjugateGradient {
            tolerance: self.tolerance,
            preconditioner: match stiffness < MILD {
                true => Preconditioner::Jacobi,
                false => Preconditioner::IncompleteCholesky,
            },
            ..ConjugateGradient::default()
        };
        iterative.solve(matrix, right, x)
    }

    fn keeps_pattern(&self) -> bool {
        self.last_was_direct
    }
}

register!(
    LinearSolverEntry [2, 3],
    Automatic,
    "automatic",
    "Cholesky or conjugate gradients, by size and stiffness of every system",
    "docs/implicit.md"
);
