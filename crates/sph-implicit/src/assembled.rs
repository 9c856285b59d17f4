//! A matrix that is written down, as an operator.

use sph_core::Vect;

use crate::halved::Halved;
use crate::{Matrix, Operator};

impl<const D: usize> Operator<D> for Matrix<D> {
    fn rows(&self) -> usize {
        Matrix::rows(self)
    }

    fn multiply(&self, x: &[Vect<D>], y: &mut [Vect<D>]) {
        Matrix::multiply(self, x, y);
    }

    fn prepared(&self) -> Option<Box<dyn Operator<D> + '_>> {
        Some(Box::new(Halved::of(self)))
    }

    fn assembled(&self) -> Option<&Matrix<D>> {
        Some(self)
    }
}
