//! Preconditioners of the iterative solvers.

use rayon::prelude::*;
use sph_core::{Lent, Shelf, Vect, parameters};

use crate::incomplete::Incomplete;
use crate::matrix::{Entries, ROWS, Values};
use crate::{Block, Diagonal, Entry, Operator, Pattern, SolveError};

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

/// A preconditioner of one matrix.
pub(crate) enum Bound<'s, const D: usize> {
    Nothing,
    Scalar(Lent<'s, Vec<f64>>),
    Block(Lent<'s, Vec<Block<D>>>),
    IncompleteScalar(Lent<'s, Incomplete<f64, f32>>),
    IncompleteBlock(Lent<'s, Incomplete<Block<D>, [[f32; D]; D]>>),
}

impl Preconditioner {
    /// Whether it is made of the entries of a matrix, and not of its diagonal alone.
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
        shelf: &'s Shelf,
    ) -> Result<Bound<'s, D>, SolveError> {
        if self == Preconditioner::None {
            return Ok(Bound::Nothing);
        }
        let missing = || SolveError::NotWhole {
            method: method.into(),
        };
        let failed = |row| SolveError::NotPositive {
            method: method.into(),
            row,
        };
        if !self.factorises() {
            let diagonal = operator.diagonal().ok_or_else(missing)?;
            let bound = match diagonal {
                Diagonal::Scalar(all) => inverted::<D, _>(shelf, all, |d| *d).map(Bound::Scalar),
                Diagonal::Block(all) if self == Preconditioner::Jacobi => {
                    inverted::<D, _>(shelf, all, Entry::<D>::diagonal).map(Bound::Block)
                }
                Diagonal::Block(all) => inverted::<D, _>(shelf, all, |d| *d).map(Bound::Block),
            };
            return bound.map_err(failed);
        }
        let matrix = operator.assembled().ok_or_else(missing)?;
        let quick = self == Preconditioner::IncompleteDiagonal;
        Ok(match &matrix.entries {
            Entries::Scalar(values) => Bound::IncompleteScalar(
                incomplete::<D, _>(shelf, &matrix.pattern, values, quick).map_err(failed)?,
            ),
            Entries::Block(values) => Bound::IncompleteBlock(
                incomplete::<D, _>(shelf, &matrix.pattern, values, quick).map_err(failed)?,
            ),
        })
    }
}

/// An incomplete factorisation, or the first row whose pivot is not positive.
fn incomplete<'s, const D: usize, E: Entry<D>>(
    shelf: &'s Shelf,
    pattern: &Pattern,
    values: &Values<E>,
    pivots_only: bool,
) -> Result<Lent<'s, Incomplete<E, E::Short>>, usize> {
    let mut factor = shelf.lend::<Incomplete<E, E::Short>>();
    factor.refill::<D>(pattern, values, pivots_only)?;
    Ok(factor)
}

/// The inverses of parts of the diagonal, or the first row that has none.
fn inverted<'s, const D: usize, E: Entry<D>>(
    shelf: &'s Shelf,
    diagonal: &[E],
    part: impl Fn(&E) -> E,
) -> Result<Lent<'s, Vec<E>>, usize> {
    let mut inverse = shelf.lend::<Vec<E>>();
    inverse.clear();
    for (i, d) in diagonal.iter().enumerate() {
        inverse.push(part(d).inverted().ok_or(i)?);
    }
    Ok(inverse)
}

impl<const D: usize> Bound<'_, D> {
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
