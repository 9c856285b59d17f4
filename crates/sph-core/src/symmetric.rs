//! Symmetric tensors in space.

use std::ops::{Add, Mul, Sub};

#[cfg(feature = "plugins")]
use nalgebra::Matrix3;

#[cfg(feature = "plugins")]
use crate::Vect;

/// A symmetric 3 × 3 tensor: xx, yy, zz, xy, yz, xz.
///
/// Plane problems use it as well: a motion in the plane leaves a component out of it.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Symmetric(pub [f64; 6]);

impl Symmetric {
    /// The zero tensor.
    pub const ZERO: Symmetric = Symmetric([0.0; 6]);

    /// Place of the component of a row and a column.
    pub const PLACE: [[usize; 3]; 3] = [[0, 3, 5], [3, 1, 4], [5, 4, 2]];

    /// ½(A + Aᵀ) of a matrix, given by its rows or its columns.
    #[inline]
    pub fn part_of(a: impl Into<[[f64; 3]; 3]>) -> Self {
        let a = a.into();
        let mean = |i: usize, j: usize| 0.5 * (a[i][j] + a[j][i]);
        Symmetric([
            a[0][0],
            a[1][1],
            a[2][2],
            mean(0, 1),
            mean(1, 2),
            mean(0, 2),
        ])
    }

    /// Its rows, which are its columns as well.
    #[inline]
    pub fn rows(&self) -> [[f64; 3]; 3] {
        let [xx, yy, zz, xy, yz, xz] = self.0;
        [[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]]
    }

    /// A_xx + A_yy + A_zz.
    #[inline]
    pub fn trace(&self) -> f64 {
        self.0[0] + self.0[1] + self.0[2]
    }

    /// A − ⅓ tr(A) I.
    #[inline]
    pub fn deviator(&self) -> Self {
        let third = self.trace() / 3.0;
        let [xx, yy, zz, xy, yz, xz] = self.0;
        Symmetric([xx - third, yy - third, zz - third, xy, yz, xz])
    }

    /// A:B = Σ A_ij B_ij.
    #[inline]
    pub fn contract(&self, other: &Self) -> f64 {
        let (a, b) = (&self.0, &other.0);
        let diagonal = a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
        diagonal + 2.0 * (a[3] * b[3] + a[4] * b[4] + a[5] * b[5])
    }
}

#[cfg(feature = "plugins")]
impl Symmetric {
    /// As a full matrix.
    #[inline]
    pub fn matrix(&self) -> Matrix3<f64> {
        self.rows().into()
    }

    /// A·v in the plane, or in space.
    #[inline(always)]
    pub fn apply<const D: usize>(&self, v: &Vect<D>) -> Vect<D> {
        let rows = self.rows();
        Vect::from_fn(|i, _| (0..D).map(|j| rows[i][j] * v[j]).sum())
    }
}

impl Add for Symmetric {
    type Output = Self;
    #[inline(always)]
    fn add(self, other: Self) -> Self {
        Symmetric(std::array::from_fn(|k| self.0[k] + other.0[k]))
    }
}

impl Sub for Symmetric {
    type Output = Self;
    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        Symmetric(std::array::from_fn(|k| self.0[k] - other.0[k]))
    }
}

impl Mul<f64> for Symmetric {
    type Output = Self;
    #[inline(always)]
    fn mul(self, factor: f64) -> Self {
        Symmetric(self.0.map(|c| c * factor))
    }
}

#[cfg(all(test, feature = "plugins"))]
mod tests {
    use nalgebra::Vector3;

    use super::*;

    #[test]
    fn operations_are_those_of_the_matrix() {
        let a = Matrix3::new(1.0, 2.0, -3.0, 0.5, -1.0, 4.0, 2.5, 0.25, 7.0);
        let s = Symmetric::part_of(a);
        let m = s.matrix();
        assert_eq!(m, 0.5 * (a + a.transpose()));
        assert_eq!(s.trace(), m.trace());
        assert!((s.contract(&s) - m.component_mul(&m).sum()).abs() < 1e-13);
        let v = Vector3::new(0.3, -2.0, 1.5);
        assert!((s.apply(&v) - m * v).norm() < 1e-14);
        assert!(s.deviator().trace().abs() < 1e-15);
        assert_eq!((s + s - s * 2.0), Symmetric::ZERO);
    }
}
