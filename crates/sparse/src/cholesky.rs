//! Factorisation by faer: the order of elimination is kept while only numbers change.

use faer::dyn_stack::{MemBuffer, MemStack};
use faer::linalg::cholesky::llt::factor::LltError;
use faer::perm::PermRef;
use faer::sparse::linalg::cholesky::{
    CholeskySymbolicParams, LltRef, SymbolicCholesky, SymbolicCholeskyRaw, SymmetricOrdering,
    factorize_symbolic_cholesky,
};
use faer::sparse::{SparseColMatRef, SymbolicSparseColMatRef};
use faer::{Conj, Mat, Par, Side, Spec};

use crate::{SparseError, UpperTriangle, substitution};

/// Right sides for which memory is kept.
const COLUMNS: usize = 4;

/// The order in which unknowns are eliminated.
#[derive(Clone, Copy, Debug)]
pub enum Order<'a> {
    /// Approximate minimum degree (Amestoy, Davis & Duff 1996).
    MinimumDegree,
    /// The numbers of the unknowns, each once, as from [`nested_dissection`](crate::nested_dissection).
    Given(&'a [u32]),
}

/// A = L Lᵀ. One thread: the same bits with any number of them.
pub struct Cholesky {
    symbolic: SymbolicCholesky<u32>,
    factor: Vec<f64>,
    /// Memory of a solve: the unknowns in the order of elimination, and the sums of supernodes.
    room: [Vec<f64>; 2],
    stack: MemBuffer,
}

impl Cholesky {
    /// The symbolic phase: the shape of the factor for an order of elimination.
    ///
    /// # Errors
    /// Too little memory.
    ///
    /// # Panics
    /// If an order is given that is no permutation of the unknowns.
    pub fn analyse(matrix: &UpperTriangle, order: Order) -> Result<Self, SparseError> {
        let unknowns = matrix.len();
        let no_memory = || SparseError::NoMemory(unknowns);
        let mut inverse = Vec::new();
        let order = match order {
            Order::MinimumDegree => SymmetricOrdering::Amd,
            Order::Given(order) => {
                inverse.resize(unknowns, 0);
                for (place, unknown) in (0_u32..).zip(order) {
                    inverse[*unknown as usize] = place;
                }
                SymmetricOrdering::Custom(PermRef::new_checked(order, &inverse, unknowns))
            }
        };
        let symbolic = factorize_symbolic_cholesky(
            shape(matrix),
            Side::Upper,
            order,
            CholeskySymbolicParams::default(),
        );
        let symbolic = symbolic.map_err(|_| no_memory())?;
        let mut factor = Vec::new();
        let room = factor.try_reserve_exact(symbolic.len_val());
        room.map_err(|_| no_memory())?;
        factor.resize(symbolic.len_val(), 0.0);
        let room = symbolic.factorize_numeric_llt_scratch::<f64>(Par::Seq, Spec::default());
        let room = room.or(symbolic.solve_in_place_scratch::<f64>(COLUMNS, Par::Seq));
        Ok(Self {
            symbolic,
            factor,
            room: Default::default(),
            stack: MemBuffer::try_new(room).map_err(|_| no_memory())?,
        })
    }

    /// The numeric phase, for a matrix of the shape that was analysed.
    ///
    /// # Errors
    /// A matrix that is not positive definite.
    pub fn factorise(&mut self, matrix: &UpperTriangle) -> Result<(), SparseError> {
        let done = self.symbolic.factorize_numeric_llt(
            &mut self.factor,
            SparseColMatRef::new(shape(matrix), &matrix.values),
            Side::Upper,
            Default::default(),
            Par::Seq,
            MemStack::new(&mut self.stack),
            Spec::default(),
        );
        let refused =
            |LltError::NonPositivePivot { index }| SparseError::NotPositive(index, matrix.len());
        done.map(|_| ()).map_err(refused)
    }

    /// Numbers of the factor.
    pub fn size(&self) -> usize {
        self.factor.len()
    }

    /// The solution for one right side.
    pub fn solve(&mut self, right: &[f64]) -> Vec<f64> {
        if let (SymbolicCholeskyRaw::Supernodal(nodes), Some(order)) =
            (self.symbolic.raw(), self.symbolic.perm())
        {
            let (from, to) = order.arrays();
            let [x, sums] = &mut self.room;
            x.clear();
            x.extend(from.iter().map(|i| right[*i as usize]));
            substitution::solve(nodes, &self.factor, x, sums);
            return to.iter().map(|i| x[*i as usize]).collect();
        }
        let x = self.solve_columns(1, |r, _| right[r]);
        (0..right.len()).map(|r| x(r, 0)).collect()
    }

    /// The solutions for up to four right sides by faer's own substitution, each by row and column.
    pub fn solve_columns<F: Fn(usize, usize) -> f64>(
        &mut self,
        columns: usize,
        right: F,
    ) -> impl Fn(usize, usize) -> f64 + use<F> {
        let mut dense = Mat::from_fn(self.symbolic.nrows(), columns, right);
        let factor = LltRef::new(&self.symbolic, &self.factor);
        let stack = MemStack::new(&mut self.stack);
        factor.solve_in_place_with_conj(Conj::No, dense.as_mut(), Par::Seq, stack);
        move |row, column| dense[(row, column)]
    }
}

fn shape(matrix: &UpperTriangle) -> SymbolicSparseColMatRef<'_, u32> {
    let n = matrix.len();
    SymbolicSparseColMatRef::new_checked(n, n, &matrix.starts, None, &matrix.rows)
}

#[cfg(test)]
mod tests {
    use nalgebra::Vector3;

    use super::*;
    use crate::{conjugate_gradient, nested_dissection};

    /// The five-point Laplacian on a square of `side` × `side` unknowns, with their places.
    fn laplacian(side: u32) -> (UpperTriangle, Vec<Vector3<f64>>) {
        let (mut entries, mut places) = (Vec::new(), Vec::new());
        for number in 0..side * side {
            let (x, y) = (number % side, number / side);
            places.push(Vector3::new(x.into(), y.into(), 0.0));
            entries.extend((x > 0).then(|| (number, number - 1, -1.0)));
            entries.extend((y > 0).then(|| (number, number - side, -1.0)));
        }
        (
            UpperTriangle::new(&vec![4.0; places.len()], entries),
            places,
        )
    }

    /// |b − A x| over |b|, largest components.
    fn residual(matrix: &UpperTriangle, x: &[f64], right: &[f64]) -> f64 {
        let mut image = vec![0.0; x.len()];
        matrix.multiply(x, &mut image);
        let largest = |of: &mut dyn Iterator<Item = f64>| of.fold(0.0, |a: f64, b| a.max(b.abs()));
        largest(&mut image.iter().zip(right).map(|(a, b)| a - b))
            / largest(&mut right.iter().copied())
    }

    /// Both orders, both substitutions and the iterations agree on a system of 1600 unknowns.
    #[test]
    fn all_ways_solve_the_same_system() {
        let (matrix, places) = laplacian(40);
        let right: Vec<_> = (0..matrix.len()).map(|i| (0.1 * i as f64).sin()).collect();
        let order = nested_dissection(&matrix, &places);
        for order in [Order::MinimumDegree, Order::Given(&order)] {
            let mut factor = Cholesky::analyse(&matrix, order).expect("memory");
            factor.factorise(&matrix).expect("positive definite");
            assert!(residual(&matrix, &factor.solve(&right), &right) < 1e-13);
            let columns = factor.solve_columns(2, |r, c| right[r] * (c + 1) as f64);
            let second: Vec<_> = (0..right.len()).map(|r| columns(r, 1) / 2.0).collect();
            assert!(residual(&matrix, &second, &right) < 1e-13);
        }
        let mut x = vec![0.0; right.len()];
        conjugate_gradient(&matrix, &right, &mut x, 1e-12, 500).expect("converges");
        assert!(residual(&matrix, &x, &right) < 1e-11);
        let stopped = conjugate_gradient(&matrix, &right, &mut vec![0.0; right.len()], 1e-12, 3);
        assert!(matches!(stopped, Err(SparseError::NotConverged(_, 3))));
    }

    /// A matrix with a negative eigenvalue is refused by the row of its pivot.
    #[test]
    fn a_matrix_that_is_not_positive_definite_is_refused() {
        let matrix = UpperTriangle::new(&[1.0, 1.0], vec![(1, 0, 2.0)]);
        let mut factor = Cholesky::analyse(&matrix, Order::Given(&[0, 1])).expect("memory");
        let refused = factor.factorise(&matrix);
        assert_eq!(refused, Err(SparseError::NotPositive(2, 2)));
    }
}
