//! Factorisation by faer: the order of elimination is kept while only numbers change.

use faer::dyn_stack::{MemBuffer, MemStack};
use faer::perm::PermRef;
use faer::sparse::linalg::cholesky::{
    CholeskySymbolicParams, LltRef, SymbolicCholesky, SymbolicCholeskyRaw, SymmetricOrdering,
    factorize_symbolic_cholesky,
};
use faer::sparse::{SparseColMatRef, SymbolicSparseColMatRef};
use faer::{Conj, Mat, Par, Side, Spec};

use crate::flow::FlowError;
use crate::flow::matrix::Matrix;
use crate::flow::substitution;

/// A = L Lᵀ. One thread: the same bits with any number of them.
pub struct Cholesky {
    symbolic: SymbolicCholesky<u32>,
    factor: Vec<f64>,
    /// Memory of a solve: the unknowns in the order of elimination, and what supernodes sum.
    room: [Vec<f64>; 2],
    stack: MemBuffer,
}

impl Cholesky {
    /// The symbolic phase: the shape of the factor for an order of elimination.
    pub fn analyse(matrix: &Matrix, order: &[u32]) -> Result<Self, FlowError> {
        let unknowns = matrix.len();
        let no_memory = || FlowError::NoMemory { unknowns };
        let mut inverse = vec![0; unknowns];
        for (place, unknown) in (0_u32..).zip(order) {
            inverse[*unknown as usize] = place;
        }
        let symbolic = factorize_symbolic_cholesky(
            shape(matrix),
            Side::Upper,
            SymmetricOrdering::Custom(PermRef::new_checked(order, &inverse, unknowns)),
            CholeskySymbolicParams::default(),
        );
        let symbolic = symbolic.map_err(|_| no_memory())?;
        let mut factor = Vec::new();
        let room = factor.try_reserve_exact(symbolic.len_val());
        room.map_err(|_| no_memory())?;
        factor.resize(symbolic.len_val(), 0.0);
        let room = symbolic.factorize_numeric_llt_scratch::<f64>(Par::Seq, Spec::default());
        let room = room.or(symbolic.solve_in_place_scratch::<f64>(1, Par::Seq));
        Ok(Self {
            symbolic,
            factor,
            room: Default::default(),
            stack: MemBuffer::try_new(room).map_err(|_| no_memory())?,
        })
    }

    /// The numeric phase.
    pub fn factorise(&mut self, matrix: &Matrix) -> Result<(), FlowError> {
        let done = self.symbolic.factorize_numeric_llt(
            &mut self.factor,
            SparseColMatRef::new(shape(matrix), &matrix.values),
            Side::Upper,
            Default::default(),
            Par::Seq,
            MemStack::new(&mut self.stack),
            Spec::default(),
        );
        let unknowns = matrix.len();
        done.map(|_| ())
            .map_err(|_| FlowError::NotDefinite { unknowns })
    }

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
        let mut dense = Mat::from_fn(right.len(), 1, |r, _| right[r]);
        let factor = LltRef::new(&self.symbolic, &self.factor);
        let stack = MemStack::new(&mut self.stack);
        factor.solve_in_place_with_conj(Conj::No, dense.as_mut(), Par::Seq, stack);
        (0..right.len()).map(|r| dense[(r, 0)]).collect()
    }
}

fn shape(matrix: &Matrix) -> SymbolicSparseColMatRef<'_, u32> {
    let n = matrix.len();
    SymbolicSparseColMatRef::new_checked(n, n, &matrix.starts, None, &matrix.rows)
}
