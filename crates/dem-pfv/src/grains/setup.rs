//! Parts of a system of grains, their columns, and the axes along which space repeats itself.

use std::f64::consts::PI;

use serde::{Deserialize, Serialize};

use crate::grains::{ContactLaw, GrainError, Mesh, Vector, Wall};
use crate::sphere;

/// A sphere at the start.
#[derive(Clone, Copy, Debug, Default, Deserialize, PartialEq, Serialize)]
pub struct Grain {
    /// Centre, m.
    pub position: Vector,
    /// Velocity, m/s.
    pub velocity: Vector,
    /// Angular velocity, rad/s.
    pub spin: Vector,
    /// Radius R, m.
    pub radius: f64,
    /// Density ρ_s, kg/m³.
    pub density: f64,
    /// True if it keeps its velocity under any force.
    pub held: bool,
}

impl Grain {
    /// At rest; radius in m, density in kg/m³.
    pub fn new(position: [f64; 3], radius: f64, density: f64) -> Self {
        Self {
            position: position.into(),
            radius,
            density,
            ..Self::default()
        }
    }

    /// The same with a velocity, m/s.
    #[must_use]
    pub fn moving(mut self, velocity: [f64; 3]) -> Self {
        self.velocity = velocity.into();
        self
    }

    /// Names the first value that is impossible for a grain.
    pub(crate) fn check(&self, grain: usize) -> Result<(), GrainError> {
        positive(grain, "radius", self.radius)?;
        positive(grain, "density", self.density)?;
        finite(grain, "position", &self.position)?;
        finite(grain, "velocity", &self.velocity)?;
        finite(grain, "angular velocity", &self.spin)
    }
}

pub(crate) fn finite(grain: usize, what: &'static str, v: &Vector) -> Result<(), GrainError> {
    match v.iter().all(|x| x.is_finite()) {
        true => Ok(()),
        false => Err(GrainError::NotFinite(grain, what, (*v).into())),
    }
}

pub(crate) fn positive(grain: usize, what: &'static str, value: f64) -> Result<(), GrainError> {
    match value > 0.0 && value.is_finite() {
        true => Ok(()),
        false => Err(GrainError::NotPositive(grain, what, value)),
    }
}

/// Lower and upper end (m) of each axis along which the box repeats itself.
pub type Period = [Option<[f64; 2]>; 3];

/// Everything a [`crate::grains::GrainSystem`] starts from.
#[derive(Debug, Default)]
pub struct Setup {
    /// The grains.
    pub grains: Vec<Grain>,
    /// Contact laws; the first is that of grains with each other, walls and meshes name theirs by number.
    pub laws: Vec<Box<dyn ContactLaw>>,
    /// Planes.
    pub walls: Vec<Wall>,
    /// Surfaces of triangles.
    pub meshes: Vec<Mesh>,
    /// Axes along which the box repeats itself.
    pub period: Period,
    /// Gravity, m/s².
    pub gravity: Vector,
    /// Coefficient D_a of non-viscous damping, at least 0 and below 1. Source: Catalano 2012, Eq. (2.15).
    pub damping: f64,
    /// Skin of the lists of neighbours, m; `None` takes a fifth of the mean radius.
    pub skin: Option<f64>,
}

impl Setup {
    /// Grains that follow one law, without walls, gravity or damping.
    pub fn new(grains: Vec<Grain>, law: impl ContactLaw + 'static) -> Self {
        Self {
            grains,
            laws: vec![Box::new(law)],
            ..Self::default()
        }
    }

    /// Adds a law; its number is one more than that of the last.
    #[must_use]
    pub fn law(mut self, law: impl ContactLaw + 'static) -> Self {
        self.laws.push(Box::new(law));
        self
    }

    /// Adds walls.
    #[must_use]
    pub fn walls(mut self, walls: impl IntoIterator<Item = Wall>) -> Self {
        self.walls.extend(walls);
        self
    }

    /// Adds a mesh.
    #[must_use]
    pub fn mesh(mut self, mesh: Mesh) -> Self {
        self.meshes.push(mesh);
        self
    }

    /// Repeats the box along an axis, from and to in m.
    #[must_use]
    pub fn periodic(mut self, axis: usize, from: f64, to: f64) -> Self {
        if let Some(slot) = self.period.get_mut(axis) {
            *slot = Some([from, to]);
        }
        self
    }

    /// Sets gravity, m/s².
    #[must_use]
    pub fn gravity(mut self, gravity: [f64; 3]) -> Self {
        self.gravity = gravity.into();
        self
    }

    /// Sets the coefficient of non-viscous damping.
    #[must_use]
    pub fn damping(mut self, damping: f64) -> Self {
        self.damping = damping;
        self
    }
}

/// Vector from `b` to the nearest image of `a`, m.
#[inline]
pub(crate) fn separation(a: &Vector, b: &Vector, period: &Period) -> Vector {
    let mut d = a - b;
    for (axis, ends) in period.iter().enumerate() {
        if let Some([from, to]) = ends {
            let length = to - from;
            if d[axis] > 0.5 * length {
                d[axis] -= length;
            } else if d[axis] < -0.5 * length {
                d[axis] += length;
            }
        }
    }
    d
}

/// Brings a point back into the period. It is done at every step, so that positions do not depend on when
/// lists are renewed.
#[inline]
pub(crate) fn wrap(point: &mut Vector, period: &Period) {
    for (axis, ends) in period.iter().enumerate() {
        if let Some([from, to]) = ends {
            let x = point[axis];
            if x < *from || x >= *to {
                point[axis] = from + (x - from).rem_euclid(to - from);
            }
        }
    }
}

/// Ends of a period are finite, in order, and far enough apart that a pair touches only once.
pub(crate) fn check_period(period: &Period, reach: f64) -> Result<(), GrainError> {
    for (axis, ends) in period.iter().enumerate() {
        if let Some([from, to]) = ends {
            let (length, least) = (to - from, 2.0 * reach);
            if !(length.is_finite() && length > least) {
                return Err(GrainError::ShortPeriod(axis, length, least));
            }
        }
    }
    Ok(())
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
