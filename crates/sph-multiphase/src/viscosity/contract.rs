//! The trait of viscous operators, and viscosities of eddies that particles do not resolve.

use sph_contribution::{Contribution, Stages, contribution_kind};
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

contribution_kind!(
    /// A turbulence model that acts as a viscosity η_t beside that of the laws: τ = 2 (η + η_t) D. Those of this project are in
    /// `sph-turbulence`.
    ///
    /// It offers a stage that writes [`EDDY_VISCOSITY`](sph_core::fields::EDDY_VISCOSITY), Pa s. The stage may read the
    /// velocity gradient and the strain rate, whether or not a law needs them, and writes zero where there is no turbulence, as
    /// within a soil. An implicit step takes η_t of its beginning.
    pub EddyViscosityEntry, "eddy-viscosity", One, "viscosity of eddies that particles do not resolve",
    .ordered(50).works(Work::Friction)
);
