//! A matrix that is written down, as an operator.

use sph_core::Vect;

use crate::linear::{Halved, Halves, Matrix, Operator};

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

impl<const D: usize> Operator<D> for Halved<'_, D> {
    fn rows(&self) -> usize {
        Halved::rows(self)
    }

    fn multiply(&self, x: &[Vect<D>], y: &mut [Vect<D>]) {
        Halved::multiply(self, x, y);
    }
}
