//! The state of a system of grains: its columns, saved and resumed.

use std::f64::consts::PI;

use serde::{Deserialize, Serialize};

use crate::grains::{
    ContactLaw, Grain, GrainError, GrainSystem, Mesh, Period, Table, Vector, Wall, positive,
};
use crate::sphere;

/// A step and the grain that sets it.
#[derive(Clone, Copy, Debug, Deserialize, PartialEq, Serialize)]
pub(crate) struct Limit {
    pub step: f64,
    pub grain: usize,
}

/// Everything a run needs to go on bit for bit, but for the contact laws: columns of the grains, walls,
/// meshes, and the memory of contacts. For any serde format that keeps every bit of a number.
#[derive(Clone, Debug, Default, Deserialize, Serialize)]
pub struct State {
    /// The grains; the next evaluation finds the contacts of those that were moved.
    pub grains: Grains,
    /// The walls.
    pub walls: Vec<Wall>,
    /// The meshes.
    pub meshes: Vec<Mesh>,
    /// Axes along which the box repeats itself.
    pub period: Period,
    /// Gravity, m/s².
    pub gravity: Vector,
    pub(crate) damping: f64,
    pub(crate) skin: f64,
    /// Time, s.
    pub time: f64,
    /// Steps made.
    pub steps: u64,
    /// Motion since the last evaluation, s.
    pub(crate) last_step: f64,
    pub(crate) limit: Option<Limit>,
    /// Step at which the limit is found anew.
    pub(crate) limit_due: u64,
    #[serde(rename = "contacts")]
    pub(crate) table: Table,
    /// Number of times that the lists of neighbours were made.
    pub renewals: u64,
}

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
        let n = self.len();
        let forces = [&self.contact_force, &self.contact_torque];
        let outer = [&self.external_force, &self.external_torque];
        let motion = [&self.velocity, &self.spin].into_iter();
        let mut vectors = motion.chain(forces).chain(outer);
        let mut numbers = [&self.radius, &self.density, &self.mass].into_iter();
        let others = self.orientation.len() == n && self.held.len() == n;
        others && vectors.all(|c| c.len() == n) && numbers.all(|c| c.len() == n)
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
        self.radius.iter().map(|r| sphere(*r)).sum()
    }

    /// Mean radius, m.
    pub fn mean_radius(&self) -> f64 {
        self.radius.iter().sum::<f64>() / self.len() as f64
    }

    /// Largest radius, m.
    pub fn largest_radius(&self) -> f64 {
        self.radius.iter().copied().fold(0.0, f64::max)
    }
}

impl GrainSystem {
    /// State to resume.
    pub fn save(&self) -> State {
        self.state.clone()
    }

    /// Goes on from a saved state with the same laws. The lists of neighbours are made anew, which changes no
    /// bit of what follows: contacts are summed in the order of the grains' numbers, whatever else is in the lists.
    ///
    /// # Errors
    /// A state whose parts do not fit together, and laws out of range.
    pub fn resume(state: State, laws: Vec<Box<dyn ContactLaw>>) -> Result<Self, GrainError> {
        let bad = |problem| Err(GrainError::BadState(problem));
        let (table, n) = (&state.table, state.grains.len());
        if !state.grains.fits() {
            return bad("columns of the grains differ in length");
        }
        let parts = 1 + state.walls.len() + state.meshes.len();
        let ordered = table.ends.is_sorted() && table.ends.last() == Some(&table.slots.len());
        if table.ends.len() != parts || !ordered {
            return bad("contacts do not fit the walls and meshes");
        }
        for part in 0..parts {
            let most = match part.checked_sub(1 + state.walls.len()) {
                Some(mesh) => state.meshes[mesh].triangles.len(),
                None => n,
            };
            let known = |k: usize| {
                let slot = &table.slots[k];
                (slot.first as usize) < n && (slot.second as usize) < most
            };
            if !table.part(part).all(known) {
                return bad("a contact names a body that is not there");
            }
        }
        for i in 0..n {
            positive(i, "radius", state.grains.radius[i])?;
            positive(i, "mass", state.grains.mass[i])?;
        }
        let mut system = Self { state, laws };
        system.check()?;
        system.renew();
        Ok(system)
    }
}
