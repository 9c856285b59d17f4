//! The trait of viscous operators.

use sph_contribution::Stages;
use sph_core::{Work, contract};
use sph_neighbours::Interaction;

use crate::viscosity::Coupling;

/// Source of the viscosity for a viscous operator.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Viscosity {
    /// One number for all particles, Pa s; no column exists.
    Uniform(f64),
    /// The viscosity column; one phase.
    PerParticle,
    /// The viscosity column; several phases.
    PerPhase,
}

/// A second-order operator for the viscous force.
pub trait ViscousOperator<const D: usize>: Send {
    /// The viscous term of the interaction sweep.
    fn term(&self, viscosity: Viscosity) -> Box<dyn Interaction<D>>;
    /// Columns of all particles that the term needs before the sweep.
    fn stages(&self, _viscosity: Viscosity) -> Stages<D> {
        Vec::new()
    }
    /// The same friction as rows of a matrix, for implicit schemes.
    fn coupling(&self, viscosity: Viscosity) -> Box<dyn Coupling<D>>;
    /// Stiffness over that of Morris's operator: divides the viscous step limit.
    fn stiffness(&self) -> f64;
    /// True if it is zero in rigid rotation, at free surfaces too.
    fn leaves_rotations(&self) -> bool {
        false
    }
}

contract!(
    /// A viscous operator that a scene may name.
    pub ViscousOperatorEntry, "viscous-operator", One, "the discrete div(η grad u) and its kin", ViscousOperator<D>,
    .by_default("morris").ordered(40).works(Work::Friction)
);
