//! The trait of linear systems for a solver.

use sph_core::Vect;
use sph_neighbours::inner;

use crate::linear::{Diagonal, Halved, Halves, Matrix, SolveError};

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
