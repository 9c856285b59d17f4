//! The trait of linear systems for a solver, their errors, and the arithmetic of vectors of particles.

use rayon::prelude::*;
use sph_core::Vect;
use sph_neighbours::inner;
use thiserror::Error;

use crate::linear::{Diagonal, Halved, Halves, Matrix};

/// A symmetric operator on vectors of particles, with or without a matrix behind it.
///
/// Some rows may be of copies of particles that are at home elsewhere, across a seam or in another process.
/// [`import`](Operator::import) gives copies the values of their owners, [`inner`](Operator::inner) sums over all owners.
/// A [`Matrix`] has no copies.
pub trait Operator<const D: usize>: Sync {
    /// Number of rows, those of copies included.
    fn rows(&self) -> usize;

    /// Gives the copies the values of their owners.
    fn import(&self, _x: &mut [Vect<D>]) {}

    /// Σ x·y over all particles, in an order that does not depend on the number of threads; the same bits for all.
    fn inner(&self, x: &[Vect<D>], y: &[Vect<D>]) -> f64 {
        inner(x, y)
    }

    /// True if it holds for every part of a divided system; all must call it.
    fn all(&self, holds: bool) -> bool {
        holds
    }

    /// True if all rows and their couplings are here.
    fn is_whole(&self) -> bool {
        true
    }

    /// y = A x, in the rows of copies as their owners have it.
    fn multiply(&self, x: &[Vect<D>], y: &mut [Vect<D>]);

    /// The same operator in a form that is worth its making where many products are needed; none where there is no such
    /// form.
    fn prepared<'a>(&'a self, _memory: &'a mut Halves<D>) -> Option<Halved<'a, D>> {
        None
    }

    /// Its diagonal, for preconditioners; none where it is not known.
    fn diagonal(&self) -> Option<Diagonal<'_, D>> {
        self.assembled().map(|matrix| matrix.entries.diagonal())
    }

    /// Largest ratio of the couplings of a row to the rest of its diagonal, as
    /// [`Matrix::stiffness`](crate::linear::Matrix::stiffness); none where it is not known.
    fn stiffness(&self) -> Option<f64> {
        self.assembled().map(Matrix::stiffness)
    }

    /// The entries between rows of one's own, for preconditioners and factorisations; none where no owner can write
    /// them down, which may be done on request.
    fn assembled(&self) -> Option<&Matrix<D>> {
        None
    }
}

impl<const D: usize> dyn Operator<D> + '_ {
    /// y = A x, for an x whose copies may be of an earlier iteration.
    pub(crate) fn apply(&self, x: &mut [Vect<D>], y: &mut [Vect<D>]) {
        self.import(x);
        self.multiply(x, y);
    }

    /// |x| over all rows.
    pub(crate) fn norm(&self, x: &[Vect<D>]) -> f64 {
        self.inner(x, x).sqrt()
    }

    /// r = b − A x.
    pub(crate) fn residual(&self, right: &[Vect<D>], x: &[Vect<D>], r: &mut Vec<Vect<D>>) {
        r.resize(right.len(), Vect::zeros());
        self.multiply(x, r);
        r.iter_mut().zip(right).for_each(|(r, b)| *r = b - *r);
    }

    /// The whole matrix.
    ///
    /// # Errors
    /// If it is not written down, or some of it is with the owners of copies.
    pub(crate) fn whole_matrix(&self, method: &'static str) -> Result<&Matrix<D>, SolveError> {
        let whole = self.assembled().filter(|_| self.is_whole());
        whole.ok_or(SolveError::NotWhole(method))
    }
}

impl<const D: usize> Operator<D> for Matrix<D> {
    fn rows(&self) -> usize {
        Matrix::rows(self)
    }
    fn multiply(&self, x: &[Vect<D>], y: &mut [Vect<D>]) {
        Matrix::multiply(self, x, y);
    }
    fn prepared<'a>(&'a self, memory: &'a mut Halves<D>) -> Option<Halved<'a, D>> {
        Some(Halved::new(self, memory))
    }
    fn assembled(&self) -> Option<&Matrix<D>> {
        Some(self)
    }
}

/// Rows that one thread takes at least.
const PART: usize = 2048;

/// |x|.
pub fn norm<const D: usize>(x: &[Vect<D>]) -> f64 {
    inner(x, x).sqrt()
}

/// y += s x.
pub fn add<const D: usize>(y: &mut [Vect<D>], s: f64, x: &[Vect<D>]) {
    let pairs = y.par_iter_mut().zip(x).with_min_len(PART);
    pairs.for_each(|(y, x)| *y += x * s);
}

/// y = x + s y.
pub fn scale_and_add<const D: usize>(y: &mut [Vect<D>], s: f64, x: &[Vect<D>]) {
    let pairs = y.par_iter_mut().zip(x).with_min_len(PART);
    pairs.for_each(|(y, x)| *y = x + *y * s);
}

/// A system that was not solved. There is never a silent result.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum SolveError {
    /// The residual is still too large.
    #[error(
        "{method} did not reach a relative residual of {wanted:e} in {iterations} iterations (residuals: {})",
        history_text(history)
    )]
    NotConverged {
        /// The solver.
        method: &'static str,
        /// Asked for.
        wanted: f64,
        /// Done.
        iterations: usize,
        /// Relative residuals, from the first.
        history: Vec<f64>,
    },
    /// A pivot or a curvature is not positive: the solver, and the row of the fault.
    #[error("{0}: the matrix is not positive definite at row {1}")]
    NotPositive(&'static str, usize),
    /// A number of the matrix or of a vector is not finite: the solver, and what that is of.
    #[error("{0}: {1} of the system is not finite")]
    NotFinite(&'static str, &'static str),
    /// Entries that the solver needs are not there.
    #[error("{0} needs all entries of the matrix, and this operator only multiplies")]
    NotWhole(&'static str),
    /// The factorisation has no room: the solver, and the rows of the system.
    #[error("{0}: no memory for the factorisation of {1} rows")]
    NoMemory(&'static str, usize),
}

fn history_text(history: &[f64]) -> String {
    let step = history.len().div_ceil(8).max(1);
    let each = history.iter().step_by(step).map(|r| format!("{r:.1e}"));
    let mut shown: Vec<_> = each.collect();
    if let Some(last) = history.last() {
        shown.push(format!("{last:.1e} at the end"));
    }
    shown.join(", ")
}

/// A + s Σ g gᵀ with few vectors g, s = 1 or −1: the rest of unknowns that many rows share. A alone makes its
/// preconditioner.
pub struct LowRank<'a, const D: usize> {
    /// A.
    pub base: &'a dyn Operator<D>,
    /// g, with a value for every row of A.
    pub vectors: &'a [Vec<Vect<D>>],
    /// s.
    pub sign: f64,
}

impl<const D: usize> Operator<D> for LowRank<'_, D> {
    fn rows(&self) -> usize {
        self.base.rows()
    }
    fn import(&self, x: &mut [Vect<D>]) {
        self.base.import(x);
    }
    fn inner(&self, x: &[Vect<D>], y: &[Vect<D>]) -> f64 {
        self.base.inner(x, y)
    }
    fn all(&self, holds: bool) -> bool {
        self.base.all(holds)
    }
    fn is_whole(&self) -> bool {
        self.vectors.is_empty() && self.base.is_whole()
    }
    fn multiply(&self, x: &[Vect<D>], y: &mut [Vect<D>]) {
        self.base.multiply(x, y);
        for g in self.vectors {
            add(y, self.sign * self.base.inner(g, x), g);
        }
    }
    fn prepared<'a>(&'a self, memory: &'a mut Halves<D>) -> Option<Halved<'a, D>> {
        match self.vectors.is_empty() {
            true => self.base.prepared(memory),
            false => None,
        }
    }
    fn diagonal(&self) -> Option<Diagonal<'_, D>> {
        self.base.diagonal()
    }
    fn stiffness(&self) -> Option<f64> {
        self.base.stiffness()
    }
    fn assembled(&self) -> Option<&Matrix<D>> {
        self.base.assembled()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::linear::{ConjugateGradient, Entries, LinearSolver, Pattern};

    /// (2 1 + g gᵀ) x = b with g = (1, 2, 3): x = (b − g (g·b)/(2 + g·g))/2.
    #[test]
    fn a_diagonal_and_one_direction_are_solved_for() {
        let entries = Entries::scalar(vec![2.0; 3], Vec::new());
        let base = Matrix::<1>::new(Pattern::from_rows(&[vec![], vec![], vec![]]), entries);
        let g: Vec<_> = [1.0, 2.0, 3.0].map(Vect::<1>::new).to_vec();
        let vectors = [g.clone()];
        let operator = LowRank {
            base: &base,
            vectors: &vectors,
            sign: 1.0,
        };
        let right: Vec<_> = [4.0, -1.0, 2.0].map(Vect::<1>::new).to_vec();
        let mut x = vec![Vect::<1>::zeros(); 3];
        let solved = ConjugateGradient::default().solve(&operator, &right, &mut x);
        assert!(solved.is_ok());
        let share = (4.0 - 2.0 + 6.0) / (2.0 + 14.0);
        for k in 0..3 {
            let exact = 0.5 * (right[k][0] - g[k][0] * share);
            assert!((x[k][0] - exact).abs() < 1e-8, "{k}: {}", x[k][0]);
        }
    }
}
