//! The trait of elastic forces.

use sph_core::{Work, contract};
use sph_neighbours::Interaction;

use crate::stress::{Blend, LawInputs};

/// The force of an elastic material.
pub trait ElasticForce<const D: usize>: Send {
    /// As a term of the sweep, for the laws of a scene.
    fn term(&self, law_inputs: &LawInputs) -> Box<dyn Interaction<D>>;
    /// The blended values where the material yields.
    fn blend(&self) -> Blend;
    /// True if the stress is that of the end of the step: its increment is then solved for with the viscosity, and
    /// elastic waves do not bound it.
    fn implicit(&self) -> bool {
        false
    }
    /// True if it takes steps of its own within that of the flow, in which nothing but velocities and remembered
    /// stresses changes.
    fn sub_steps(&self) -> bool {
        false
    }
    /// Strength α of the [damping](crate::stress::HourglassDamping) of motions that the stress does not resist, in a
    /// material that yields or does not.
    fn hourglass(&self, _yields: bool) -> f64 {
        0.0
    }
    /// True if it is made of [displacements](sph_core::fields::ELASTIC_DISPLACEMENT), which are then remembered, and
    /// with them stresses that are not cut.
    fn displaced(&self) -> bool {
        false
    }
    /// k in the speed √(c₀² + k𝒢/ρ₀) that bounds the step.
    fn stiffness(&self) -> f64 {
        4.0 / 3.0
    }
}

contract!(
    /// An elastic force that a scene may name.
    pub ElasticForceEntry, "elastic-force", One, "the force of an elastic material", ElasticForce<D>,
    .by_default("divergence").ordered(60).works(Work::Others)
    .idle("no law of this scene is elastic: take this table out")
);
