//! Conjugate gradients with the diagonal as preconditioner.

use crate::{SparseError, UpperTriangle};

/// Solves A x = b from the x given, to |b − A x| ≤ tolerance |b|, within `limit` iterations.
/// Source: Hestenes & Stiefel 1952; Saad 2003, Algorithm 9.1.
///
/// # Errors
/// A system that has not converged by then.
pub fn conjugate_gradient(
    matrix: &UpperTriangle,
    right: &[f64],
    x: &mut [f64],
    tolerance: f64,
    limit: usize,
) -> Result<(), SparseError> {
    let n = right.len();
    let scale = dot(right, right).sqrt();
    if scale == 0.0 {
        x.fill(0.0);
        return Ok(());
    }
    let inverse = (0..n).map(|i| 1.0 / matrix.values[matrix.diagonal(i)]);
    let inverse: Vec<_> = inverse.collect();
    let mut image = vec![0.0; n];
    matrix.multiply(x, &mut image);
    let mut residual: Vec<_> = right.iter().zip(&image).map(|(b, a)| b - a).collect();
    let mut direction = vec![0.0; n];
    let mut before = 0.0;
    let mut size = dot(&residual, &residual).sqrt() / scale;
    for _ in 0..limit {
        if size <= tolerance {
            return Ok(());
        }
        let now: f64 = (0..n).map(|i| inverse[i] * residual[i] * residual[i]).sum();
        let beta = if before == 0.0 { 0.0 } else { now / before };
        for i in 0..n {
            direction[i] = inverse[i] * residual[i] + beta * direction[i];
        }
        matrix.multiply(&direction, &mut image);
        let alpha = now / dot(&direction, &image);
        for i in 0..n {
            x[i] += alpha * direction[i];
            residual[i] -= alpha * image[i];
        }
        before = now;
        size = dot(&residual, &residual).sqrt() / scale;
        if !size.is_finite() {
            break;
        }
    }
    if size <= tolerance {
        return Ok(());
    }
    Err(SparseError::NotConverged(size, limit))
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}
