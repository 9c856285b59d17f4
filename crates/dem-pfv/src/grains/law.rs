//! The trait of contact laws.

use std::fmt::Debug;

use sph_core::Registry;
use toml::Table;

use crate::grains::{GrainError, Vector};

/// Largest number of values in the memory of a contact.
pub const MEMORY: usize = 8;

/// A contact of a grain, the first, with a second body: another grain, a wall or a triangle.
#[derive(Clone, Copy, Debug)]
pub struct Contact {
    /// Unit normal n from the second body to the first. Source: Catalano 2012, Eq. (2.4).
    pub normal: Vector,
    /// Depth of the overlap, −δ_c ≥ 0, m. Source: Catalano 2012, Eqs. (2.6), (2.7).
    pub overlap: f64,
    /// Velocity of the first body relative to the second at the contact point, m/s.
    pub velocity: Vector,
    /// Angular velocity of the first body relative to the second, rad/s.
    pub spin: Vector,
    /// Radii, m; a wall and a triangle have an infinite one.
    pub radius: [f64; 2],
    /// Masses, kg; a wall and a triangle have an infinite one.
    pub mass: [f64; 2],
    /// Time since the last evaluation, s.
    pub step: f64,
    /// Values of the law of the last evaluation; zeros in a new contact.
    pub memory: [f64; MEMORY],
    /// For the law to write: force on the first body, N; its opposite acts on the second.
    pub force: Vector,
    /// For the law to write: moment on the first body besides that of the force, N m; its opposite
    /// acts on the second.
    pub couple: Vector,
    /// Rotation since the last evaluation: n_old × n_new, n_old · n_new, θ = ½ Δt n · (ω_A + ω_B) in rad.
    pub(crate) turn: (Vector, f64, f64),
}

impl Contact {
    /// A tangential vector of the last evaluation, turned with the contact: from the old normal to the new
    /// one, then by θ = ½ Δt n · (ω_A + ω_B) about it. Both turns keep its length.
    pub fn carried(&self, vector: Vector) -> Vector {
        let (axis, cosine, twist) = self.turn;
        if cosine.is_nan() || cosine <= -0.5 {
            return Vector::zeros(); // it jumped to the other side
        }
        let along = axis.dot(&vector) / (1.0 + cosine);
        let tilted = vector * cosine + axis.cross(&vector) + axis * along;
        let half = 0.5 * twist;
        let square = half * half;
        let turned = tilted * (1.0 - square) + self.normal.cross(&tilted) * twist;
        self.tangential(turned / (1.0 + square))
    }

    /// v − (v · n) n.
    pub fn tangential(&self, vector: Vector) -> Vector {
        vector - self.normal * vector.dot(&self.normal)
    }

    /// m* = m₁ m₂ / (m₁ + m₂), kg; the grain's own mass at a wall.
    pub fn reduced_mass(&self) -> f64 {
        1.0 / (1.0 / self.mass[0] + 1.0 / self.mass[1])
    }

    /// R* = R₁ R₂ / (R₁ + R₂), m; the grain's own radius at a wall.
    pub fn reduced_radius(&self) -> f64 {
        reduced(self.radius)
    }

    /// Three remembered numbers from `first` on.
    pub fn remembered(&self, first: usize) -> Vector {
        Vector::from_column_slice(&self.memory[first..first + 3])
    }

    /// Remembers three numbers from `first` on.
    pub fn remember(&mut self, first: usize, vector: Vector) {
        self.memory[first..first + 3].copy_from_slice(vector.as_slice());
    }
}

/// R₁ R₂ / (R₁ + R₂).
pub(crate) fn reduced(radius: [f64; 2]) -> f64 {
    1.0 / (1.0 / radius[0] + 1.0 / radius[1])
}

/// Stiffnesses of one contact, for the critical step.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Stiffness {
    /// ∂F_n/∂δ, N/m.
    pub normal: f64,
    /// ∂F_s/∂u_s while nothing slides, N/m.
    pub tangential: f64,
    /// ∂M/∂θ of the rolling resistance, N m.
    pub rolling: f64,
    /// Ratio ζ of the dashpots to critical damping.
    pub damping: f64,
}

/// A contact law: forces from overlaps, velocities and the memory of each contact.
///
/// One call answers many contacts, so that laws cost no virtual call per contact. The answer to a
/// contact must depend on nothing but that contact: batches differ from one number of threads to another.
pub trait ContactLaw: Debug + Send + Sync {
    /// Checks the parameters.
    ///
    /// # Errors
    /// The parameter and its value: [`require`](crate::require).
    fn check(&self) -> Result<(), GrainError>;

    /// Names of the numbers that are remembered per contact, at most [`MEMORY`].
    fn memory(&self) -> &'static [&'static str] {
        &[]
    }

    /// Writes `force`, `couple` and `memory` of every contact.
    fn respond(&self, contacts: &mut [Contact]);

    /// Stiffnesses of a contact of bodies of these radii (m, infinite for walls) at this overlap (m).
    fn stiffness(&self, radius: [f64; 2], overlap: f64) -> Stiffness;

    /// Largest ratio µ of the tangential force to the normal one; infinite without a limit.
    fn friction(&self) -> f64 {
        f64::INFINITY
    }
}

sph_core::contract!(
    /// A contact law by its name.
    pub ContactLawEntry,
    "contact-law",
    Elsewhere,
    "forces of grains that touch, in [grains.contact.LAW], [box.contact.LAW], [wall.NAME.contact.LAW]",
    ContactLaw,
    .in_space()
);

/// The contact law of that name with these parameters.
///
/// # Errors
/// No law or two of that name; an unknown or missing parameter; a value out of range.
///
/// ```
/// use dem_pfv::grains::contact_law;
///
/// let table = "modulus = '15 MPa'\nstiffness_ratio = 0.5\nfriction = 0.577".parse().expect("TOML");
/// let law = contact_law("linear-elastic", &table)?;
/// assert_eq!(law.stiffness([0.1, 0.1], 0.0).normal, 1.5e6);
/// # Ok::<(), dem_pfv::grains::GrainError>(())
/// ```
pub fn contact_law(name: &str, parameters: &Table) -> Result<Box<dyn ContactLaw>, GrainError> {
    let registry = Registry::<ContactLawEntry>::discovered()?;
    let law = (registry.find(name)?.build)(parameters)?;
    law.check()?;
    Ok(law)
}
