//! The mobility of a body: its acceleration by a force.

use nalgebra::{Matrix3, Matrix6};

use crate::RigidState;
use crate::bodies::dynamics::Dynamics;
use crate::bodies::spatial_vector::{blocks, rotation, solve};

impl Dynamics {
    /// The inverse of mass and inertia over the free degrees at a time.
    pub fn mobility<const D: usize>(&self, now: &RigidState<D>, time: f64) -> Matrix6<f64> {
        if time < self.start || self.prescribed.iter().any(|p| p.holds(time)) {
            return Matrix6::zeros();
        }
        let turn = rotation(now);
        let inertia = turn * self.inertia * turn.transpose();
        let mass = blocks(Matrix3::identity() * self.mass, inertia);
        let column = |k| solve(mass, Matrix6::identity().column(k).into_owned(), self.free);
        Matrix6::from_columns(&std::array::from_fn::<_, 6, _>(column))
    }
}
