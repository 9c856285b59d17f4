//! Entries of a matrix: a number, or a block of the space's dimension.

use std::ops::{Add, Mul};

use nalgebra::SMatrix;
use sph_core::Vect;

/// A d × d entry.
pub type Block<const D: usize> = SMatrix<f64, D, D>;

/// An entry that acts on vectors. A number acts on all components alike.
pub trait Entry<const D: usize>:
    Copy + Send + Sync + Add<Output = Self> + Mul<f64, Output = Self> + 'static
{
    /// Nothing.
    const ZERO: Self;
    /// The same in half the memory, to seven digits.
    type Short: Copy + Send + Sync + 'static;
    /// s a, shortened.
    fn to_single(&self, factor: f64) -> Self::Short;
    /// A shortened entry at full length.
    fn long(short: &Self::Short) -> Self;
    /// a v.
    fn apply(&self, v: &Vect<D>) -> Vect<D>;
    /// aᵀ v.
    fn apply_transposed(&self, v: &Vect<D>) -> Vect<D>;
    /// a b cᵀ.
    fn triple_product(&self, middle: &Self, right: &Self) -> Self;
    /// aᵀ.
    fn transposed(&self) -> Self;
    /// a⁻¹ of a symmetric positive definite entry; nothing if it is not.
    fn inverted(&self) -> Option<Self>;
    /// Component of row r and column c; a number stands for a multiple of the unit matrix.
    fn component(&self, r: usize, c: usize) -> f64;
    /// Mean of its own diagonal: those of a row add up, as numbers do.
    fn mean(&self) -> f64 {
        (0..D).map(|k| self.component(k, k)).sum::<f64>() / D as f64
    }
    /// Largest component.
    fn largest(&self) -> f64;
    /// s 1.
    fn unit(factor: f64) -> Self;
    /// The nearest entry to a block: itself, or the mean of its diagonal.
    fn from_block(block: &Block<D>) -> Self;
    /// α 1 + β r rᵀ; a number is α.
    fn central(even: f64, along: f64, r: &Vect<D>) -> Self;
}

impl<const D: usize> Entry<D> for f64 {
    const ZERO: f64 = 0.0;
    type Short = f32;
    #[inline(always)]
    fn to_single(&self, factor: f64) -> f32 {
        (self * factor) as f32
    }
    #[inline(always)]
    fn long(short: &f32) -> f64 {
        f64::from(*short)
    }
    #[inline(always)]
    fn apply(&self, v: &Vect<D>) -> Vect<D> {
        v * *self
    }
    #[inline(always)]
    fn apply_transposed(&self, v: &Vect<D>) -> Vect<D> {
        v * *self
    }
    #[inline(always)]
    fn triple_product(&self, middle: &f64, right: &f64) -> f64 {
        self * middle * right
    }
    #[inline(always)]
    fn transposed(&self) -> f64 {
        *self
    }
    #[inline(always)]
    fn inverted(&self) -> Option<f64> {
        (*self > 0.0 && self.is_finite()).then(|| 1.0 / self)
    }
    #[inline(always)]
    fn component(&self, r: usize, c: usize) -> f64 {
        if r == c { *self } else { 0.0 }
    }
    #[inline(always)]
    fn largest(&self) -> f64 {
        self.abs()
    }
    #[inline(always)]
    fn unit(factor: f64) -> f64 {
        factor
    }
    #[inline(always)]
    fn from_block(block: &Block<D>) -> f64 {
        block.trace() / D as f64
    }
    #[inline(always)]
    fn central(even: f64, _along: f64, _r: &Vect<D>) -> f64 {
        even
    }
}

impl<const D: usize> Entry<D> for Block<D> {
    const ZERO: Self = SMatrix::from_array_storage(nalgebra::ArrayStorage([[0.0; D]; D]));
    type Short = [[f32; D]; D];
    #[inline(always)]
    fn to_single(&self, factor: f64) -> [[f32; D]; D] {
        self.data.0.map(|c| c.map(|r| (r * factor) as f32))
    }
    #[inline(always)]
    fn long(short: &[[f32; D]; D]) -> Self {
        Block::from(short.map(|c| c.map(f64::from)))
    }
    #[inline(always)]
    fn apply(&self, v: &Vect<D>) -> Vect<D> {
        // Loops: products of matrices of the library are calls where no `lto` opens them.
        let mut product = Vect::zeros();
        for c in 0..D {
            for r in 0..D {
                product[r] += self[(r, c)] * v[c];
            }
        }
        product
    }
    #[inline(always)]
    fn apply_transposed(&self, v: &Vect<D>) -> Vect<D> {
        let mut product = Vect::zeros();
        for c in 0..D {
            for r in 0..D {
                product[c] += self[(r, c)] * v[r];
            }
        }
        product
    }
    #[inline(always)]
    fn triple_product(&self, middle: &Self, right: &Self) -> Self {
        self * middle * right.transpose()
    }
    #[inline(always)]
    fn transposed(&self) -> Self {
        self.transpose()
    }
    fn inverted(&self) -> Option<Self> {
        nalgebra::linalg::Cholesky::new(*self).map(|c| c.inverse())
    }
    #[inline(always)]
    fn component(&self, r: usize, c: usize) -> f64 {
        self[(r, c)]
    }
    fn largest(&self) -> f64 {
        self.amax()
    }
    fn unit(factor: f64) -> Self {
        Block::identity() * factor
    }
    fn from_block(block: &Block<D>) -> Self {
        *block
    }
    #[inline(always)]
    fn central(even: f64, along: f64, r: &Vect<D>) -> Self {
        let mut block = Block::zeros();
        for k in 0..D {
            for i in 0..D {
                block[(i, k)] = (r[i] * along) * r[k] + if i == k { even } else { 0.0 };
            }
        }
        block
    }
}
