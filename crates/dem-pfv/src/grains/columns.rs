//! The grains of a system, a column for each quantity.

use std::f64::consts::PI;

use serde::{Deserialize, Serialize};

use crate::grains::{Grain, Vector};

/// Columns of the grains, all of the same length and order.
#[derive(Clone, Debug, Default, Deserialize, Serialize)]
pub struct Grains {
    /// Centres, m.
    pub position: Vec<Vector>,
    /// Velocities, m/s; half a step behind the positions while a system steps.
    pub velocity: Vec<Vector>,
    /// Angular velocities, rad/s.
    pub spin: Vec<Vector>,
    /// Orientations, unit quaternions (w, x, y, z) from the start to now.
    pub orientation: Vec<[f64; 4]>,
    /// Radii R, m.
    pub radius: Vec<f64>,
    pub(crate) density: Vec<f64>,
    /// Masses, kg.
    pub mass: Vec<f64>,
    /// Grains that keep their velocity whatever acts on them.
    pub held: Vec<bool>,
    /// Sums of the contact forces at the last evaluation, N.
    pub contact_force: Vec<Vector>,
    pub(crate) contact_torque: Vec<Vector>,
    /// Forces from outside, N, such as those of a fluid. They stay until they are changed.
    pub external_force: Vec<Vector>,
    /// Moments from outside, N m.
    pub external_torque: Vec<Vector>,
}

/// J / (m R²) of a homogeneous sphere.
pub(crate) const INERTIA: f64 = 0.4;

impl Grains {
    pub(crate) fn new(grains: &[Grain]) -> Self {
        let n = grains.len();
        let mut columns = Self {
            position: grains.iter().map(|g| g.position).collect(),
            velocity: grains.iter().map(|g| g.velocity).collect(),
            spin: grains.iter().map(|g| g.spin).collect(),
            orientation: vec![[1.0, 0.0, 0.0, 0.0]; n],
            radius: grains.iter().map(|g| g.radius).collect(),
            density: grains.iter().map(|g| g.density).collect(),
            mass: vec![0.0; n],
            held: grains.iter().map(|g| g.held).collect(),
            contact_force: vec![Vector::zeros(); n],
            contact_torque: vec![Vector::zeros(); n],
            external_force: vec![Vector::zeros(); n],
            external_torque: vec![Vector::zeros(); n],
        };
        columns.weigh();
        columns
    }

    /// m = (4/3) π ρ R³.
    pub(crate) fn weigh(&mut self) {
        for (i, mass) in self.mass.iter_mut().enumerate() {
            *mass = 4.0 / 3.0 * PI * self.density[i] * self.radius[i].powi(3);
        }
    }

    /// True if all columns have the same length.
    pub(crate) fn fits(&self) -> bool {
        let n = self.position.len();
        let vectors = [
            &self.velocity,
            &self.spin,
            &self.contact_force,
            &self.contact_torque,
            &self.external_force,
            &self.external_torque,
        ];
        vectors.iter().all(|c| c.len() == n)
            && self.orientation.len() == n
            && self.held.len() == n
            && [&self.radius, &self.density, &self.mass]
                .iter()
                .all(|c| c.len() == n)
    }

    /// Number of grains.
    pub fn len(&self) -> usize {
        self.position.len()
    }

    /// True if there are none.
    pub fn is_empty(&self) -> bool {
        self.position.is_empty()
    }

    /// Moment of inertia J = (2/5) m R² of a grain, kg m².
    pub fn inertia(&self, grain: usize) -> f64 {
        INERTIA * self.mass[grain] * self.radius[grain].powi(2)
    }

    /// Volume of all grains Σ (4/3) π R³, m³.
    pub fn volume(&self) -> f64 {
        self.radius.iter().map(|r| 4.0 / 3.0 * PI * r.powi(3)).sum()
    }
}
