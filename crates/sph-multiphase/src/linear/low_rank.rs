//! A system with a few directions that couple many rows.

use sph_core::Vect;

use crate::linear::vector::add;
use crate::linear::{Diagonal, Halved, Halves, Matrix, Operator};

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
