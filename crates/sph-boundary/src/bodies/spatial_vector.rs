//! Six numbers: three along the axes, three about them; and the rotation of a state.

use nalgebra::{Matrix3, Matrix6, Vector3, Vector6};

use crate::RigidState;
use crate::geometry::vector;

pub(crate) fn six(along: Vector3<f64>, about: Vector3<f64>) -> Vector6<f64> {
    Vector6::new(along.x, along.y, along.z, about.x, about.y, about.z)
}

pub(crate) fn parts(v: &Vector6<f64>) -> (Vector3<f64>, Vector3<f64>) {
    (v.fixed_rows::<3>(0).into(), v.fixed_rows::<3>(3).into())
}

pub(crate) fn blocks(along: Matrix3<f64>, about: Matrix3<f64>) -> Matrix6<f64> {
    let mut whole = Matrix6::zeros();
    whole.fixed_view_mut::<3, 3>(0, 0).copy_from(&along);
    whole.fixed_view_mut::<3, 3>(3, 3).copy_from(&about);
    whole
}

/// The solution of A x = b among those x whose components are zero where they are not free; A is symmetric and positive.
pub(crate) fn solve(mut a: Matrix6<f64>, mut b: Vector6<f64>, free: [bool; 6]) -> Vector6<f64> {
    for k in (0..6).filter(|k| !free[*k]) {
        a.row_mut(k).fill(0.0);
        a.column_mut(k).fill(0.0);
        a[(k, k)] = 1.0;
        b[k] = 0.0;
    }
    match a.cholesky() {
        Some(factors) => factors.solve(&b),
        None => Vector6::repeat(f64::NAN),
    }
}

pub(crate) fn padded(v: &[f64]) -> Vector3<f64> {
    vector::padded(v).into()
}

/// The rotation of a state; about z in two dimensions.
pub(crate) fn rotation<const D: usize>(state: &RigidState<D>) -> Matrix3<f64> {
    let mut whole = Matrix3::identity();
    for i in 0..D {
        for k in 0..D {
            whole[(i, k)] = state.pose.rotation[i][k];
        }
    }
    whole
}
