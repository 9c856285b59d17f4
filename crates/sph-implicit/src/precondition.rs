//! Preconditioners of the iterative solvers.

use rayon::prelude::*;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use sph_core::Vect;

use crate::incomplete::Incomplete;
use crate::matrix::{Entries, ROWS, Values};
use crate::{Block, Entry, Operator, Pattern, SolveError};

/// z ≈ A⁻¹ r.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize, Serialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Preconditioner {
    /// z = r.
    None,
    /// Division by the diagonal.
    Jacobi,
    /// Division by the diagonal blocks; for scalar entries the same as `jacobi`.
    BlockJacobi,
    /// A triangular factorisation that changes the diagonal only (simplified incomplete Cholesky);
    /// two serial sweeps per iteration.
    #[default]
    IncompleteDiagonal,
    /// A triangular factorisation without fill; fewer iterations for more work to make it.
    IncompleteCholesky,
}

/// A preconditioner of one matrix.
pub(crate) enum Bound<const D: usize> {
    Nothing,
    Scalar(Vec<f64>),
    Block(Vec<Block<D>>),
    IncompleteScalar(Incomplete<f64, f32>),
    IncompleteBlock(Incomplete<Block<D>, [[f32; D]; D]>),
}

impl Preconditioner {
    /// # Errors
    /// If a pivot is not positive.
    pub(crate) fn bind<const D: usize>(
        self,
        operator: &dyn Operator<D>,
        method: &'static str,
    ) -> Result<Bound<D>, SolveError> {
        if self == Preconditioner::None {
            return Ok(Bound::Nothing);
        }
        let matrix = operator.assembled().ok_or_else(|| SolveError::NotWhole {
            method: method.into(),
        })?;
        let failed = |row| SolveError::NotPositive {
            method: method.into(),
            row,
        };
        Ok(match (self, &matrix.entries) {
            (Preconditioner::Jacobi, Entries::Block(values)) => {
                let diagonal = |d: &Block<D>| Entry::<D>::diagonal(d);
                Bound::Block(inverted::<D, _>(values, diagonal).map_err(failed)?)
            }
            (Preconditioner::Jacobi | Preconditioner::BlockJacobi, Entries::Scalar(values)) => {
                Bound::Scalar(inverted::<D, _>(values, |d| *d).map_err(failed)?)
            }
            (Preconditioner::BlockJacobi, Entries::Block(values)) => {
                Bound::Block(inverted::<D, _>(values, |d| *d).map_err(failed)?)
            }
            (_, Entries::Scalar(values)) => {
                let quick = self == Preconditioner::IncompleteDiagonal;
                Bound::IncompleteScalar(incomplete::<D, _>(&matrix.pattern, values, quick, failed)?)
            }
            (_, Entries::Block(values)) => {
                let quick = self == Preconditioner::IncompleteDiagonal;
                Bound::IncompleteBlock(incomplete::<D, _>(&matrix.pattern, values, quick, failed)?)
            }
        })
    }
}

fn incomplete<const D: usize, E: Entry<D>>(
    pattern: &Pattern,
    values: &Values<E>,
    pivots_only: bool,
    failed: impl Fn(usize) -> SolveError,
) -> Result<Incomplete<E, E::Short>, SolveError> {
    Incomplete::new::<D>(pattern, values, pivots_only).map_err(failed)
}

/// The inverses of parts of the diagonal, or the first row that has none.
fn inverted<const D: usize, E: Entry<D>>(
    values: &Values<E>,
    part: impl Fn(&E) -> E,
) -> Result<Vec<E>, usize> {
    let rows = values.diagonal.iter().enumerate();
    rows.map(|(i, d)| part(d).inverted().ok_or(i)).collect()
}

impl<const D: usize> Bound<D> {
    /// Memory that it takes.
    pub fn bytes(&self) -> usize {
        match self {
            Bound::Nothing => 0,
            Bound::Scalar(inverse) => size_of_val(&inverse[..]),
            Bound::Block(inverse) => size_of_val(&inverse[..]),
            Bound::IncompleteScalar(factor) => factor.bytes(),
            Bound::IncompleteBlock(factor) => factor.bytes(),
        }
    }

    /// z ≈ A⁻¹ r.
    pub fn apply(&self, r: &[Vect<D>], z: &mut [Vect<D>]) {
        match self {
            Bound::Nothing => z.copy_from_slice(r),
            Bound::Scalar(inverse) => each(inverse, r, z),
            Bound::Block(inverse) => each(inverse, r, z),
            Bound::IncompleteScalar(factor) => factor.solve(r, z),
            Bound::IncompleteBlock(factor) => factor.solve(r, z),
        }
    }
}

fn each<const D: usize, E: Entry<D>>(inverse: &[E], r: &[Vect<D>], z: &mut [Vect<D>]) {
    let rows = z.par_iter_mut().zip(r).zip(inverse);
    rows.with_min_len(ROWS)
        .for_each(|((z, r), d)| *z = d.apply(r));
}
