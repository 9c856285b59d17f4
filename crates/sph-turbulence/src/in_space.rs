//! Gradients of the plane in space.

use nalgebra::{Matrix3, SMatrix};

/// A gradient with zeros in the direction that a plane has not.
pub(crate) fn in_space<const D: usize>(gradient: &SMatrix<f64, D, D>) -> Matrix3<f64> {
    Matrix3::from_fn(|i, j| gradient.get((i, j)).copied().unwrap_or(0.0))
}
