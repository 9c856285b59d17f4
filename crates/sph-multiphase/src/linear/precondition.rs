//! Preconditioners of the iterative solvers.

use rayon::prelude::*;
use sph_core::{Vect, parameters};

use crate::linear::incomplete::Incomplete;
use crate::linear::matrix::{Entries, ROWS};
use crate::linear::{Block, Diagonal, Entry, Matrix, Operator, SolveError};

/// z ≈ A⁻¹ r.
#[parameters]
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

pub(crate) enum BoundPreconditioner<'s, const D: usize> {
    Nothing,
    Scalar(&'s [f64]),
    Block(&'s [Block<D>]),
    IncompleteScalar(&'s Incomplete<f64, D>),
    IncompleteBlock(&'s Incomplete<Block<D>, D>),
}

#[derive(Default)]
pub(crate) struct Factors<const D: usize> {
    scalar: Vec<f64>,
    block: Vec<Block<D>>,
    incomplete_scalar: Incomplete<f64, D>,
    incomplete_block: Incomplete<Block<D>, D>,
}

impl Preconditioner {
    /// True if it is made of the entries of a matrix, and not of its diagonal alone.
    pub fn factorises(self) -> bool {
        matches!(
            self,
            Preconditioner::IncompleteDiagonal | Preconditioner::IncompleteCholesky
        )
    }

    /// # Errors
    /// If a pivot is not positive.
    pub(crate) fn bind<'s, const D: usize>(
        self,
        operator: &dyn Operator<D>,
        method: &'static str,
        factors: &'s mut Factors<D>,
    ) -> Result<BoundPreconditioner<'s, D>, SolveError> {
        use BoundPreconditioner as Bound;
        let missing = SolveError::NotWhole(method);
        let bound = if self == Preconditioner::None {
            Ok(Bound::Nothing)
        } else if self.factorises() {
            let Matrix { pattern, entries } = operator.assembled().ok_or(missing)?;
            let quick = self == Preconditioner::IncompleteDiagonal;
            match entries {
                Entries::Scalar(own) => {
                    let factor = factors.incomplete_scalar.refill(pattern, own, quick);
                    factor.map(Bound::IncompleteScalar)
                }
                Entries::Block(own) => {
                    let factor = factors.incomplete_block.refill(pattern, own, quick);
                    factor.map(Bound::IncompleteBlock)
                }
            }
        } else {
            let whole = self == Preconditioner::BlockJacobi;
            let part = |d: &Block<D>| match whole {
                true => *d,
                false => Block::from_diagonal(&d.diagonal()),
            };
            match operator.diagonal().ok_or(missing)? {
                Diagonal::Scalar(all) => {
                    inverted::<D, _>(&mut factors.scalar, all, |d| *d).map(Bound::Scalar)
                }
                Diagonal::Block(all) => {
                    inverted::<D, _>(&mut factors.block, all, part).map(Bound::Block)
                }
            }
        };
        bound.map_err(|row| SolveError::NotPositive(method, row))
    }
}

/// The inverses of parts of the diagonal, or the first row that has none.
fn inverted<'s, const D: usize, E: Entry<D>>(
    inverse: &'s mut Vec<E>,
    diagonal: &[E],
    part: impl Fn(&E) -> E,
) -> Result<&'s [E], usize> {
    inverse.clear();
    for (i, d) in diagonal.iter().enumerate() {
        inverse.push(part(d).inverted().ok_or(i)?);
    }
    Ok(inverse)
}

impl<const D: usize> BoundPreconditioner<'_, D> {
    /// Memory that it takes.
    pub fn bytes(&self) -> usize {
        match self {
            BoundPreconditioner::Nothing => 0,
            BoundPreconditioner::Scalar(inverse) => size_of_val(*inverse),
            BoundPreconditioner::Block(inverse) => size_of_val(*inverse),
            BoundPreconditioner::IncompleteScalar(factor) => factor.bytes(),
            BoundPreconditioner::IncompleteBlock(factor) => factor.bytes(),
        }
    }

    /// z ≈ A⁻¹ r.
    pub fn apply(&self, r: &[Vect<D>], z: &mut [Vect<D>]) {
        match self {
            BoundPreconditioner::Nothing => z.copy_from_slice(r),
            BoundPreconditioner::Scalar(inverse) => apply_inverse(inverse, r, z),
            BoundPreconditioner::Block(inverse) => apply_inverse(inverse, r, z),
            BoundPreconditioner::IncompleteScalar(factor) => factor.solve(r, z),
            BoundPreconditioner::IncompleteBlock(factor) => factor.solve(r, z),
        }
    }
}

fn apply_inverse<const D: usize, E: Entry<D>>(inverse: &[E], r: &[Vect<D>], z: &mut [Vect<D>]) {
    let rows = z.par_iter_mut().zip(r).zip(inverse);
    let rows = rows.with_min_len(ROWS);
    rows.for_each(|((z, r), d)| *z = d.apply(r));
}
