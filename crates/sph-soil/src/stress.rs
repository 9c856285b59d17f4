//! Stresses of particles by constitutive laws.
//!
//! * [`VelocityGradient`] is a kind of plugin: ∂u_i/∂x_j from a particle's neighbours and walls.
//!   [`GradientStage`] applies it, [`StrainRate`] takes the magnitude; [`StrainRateTerm`] does both within the sweep.
//! * [`ViscosityStage`] hands batches of particles to their phase's law.
//! * [`ElasticMotion`] carries remembered stresses along, [`CarriedStress`] (or [`ImplicitElasticStress`]) gives their
//!   acting part, and [`Yielded`] how the forces share where a material yields.
//! * [`ElasticForce`] is a kind of plugin: [`Divergence`] takes [`StressDivergence`] or [`AdjointDivergence`] of the stress,
//!   [`Displacement`] second differences of the way since the material was last liquid. [`Blended`] weighs forces,
//!   and [`ElasticSubSteps`] gives a force steps of its own.
//! * [`Laplace`] is an effective pressure ([`EffectivePressureEntry`]): that between the grains, where it is not that
//!   of the equation of state. [`PorePressure`] is what is left for the water.
//! * [`CoulombFriction`] brakes soils on walls that have a coefficient of friction.
//! * `contribution` brings all that into a scene.
//!
//! Nothing here runs in a scene whose laws do not need it.

mod adjoint;
mod bed_system;
mod blended;
pub(crate) mod contribution;
mod coulomb;
mod displacement;
mod divergence;
mod elastic;
mod elastic_force;
mod elastic_sub_steps;
mod gathered;
mod gradient;
mod laplace;
mod law_inputs;
mod law_stages;
pub(crate) mod soil_surface;
mod strain_rate;

pub use adjoint::{AdjointDivergence, StressCorrection};
pub use blended::Blended;
pub use contribution::ElasticWaveLimit;
pub use coulomb::CoulombFriction;
pub use displacement::{Displacement, DisplacementForce};
pub use divergence::{Divergence, HourglassDamping, StressDivergence};
pub use elastic::ElasticMotion;
pub use elastic_force::{ElasticForce, ElasticForceEntry};
pub use elastic_sub_steps::ElasticSubSteps;
pub use gradient::{
    Isotropic, NeighbourSums, Renormalised, SymmetricDifference, VelocityGradient,
    VelocityGradientEntry,
};
pub use laplace::{EffectivePressureEntry, Laplace, PorePressure, PressureSolver, Soils};
pub use law_inputs::{Blend, LawInputs};
pub use law_stages::{CarriedStress, ImplicitElasticStress, ViscosityStage, Yielded};
pub use strain_rate::{GradientStage, StrainRate, StrainRateTerm};

/// The laws of a scene, in the order of the phase numbers.
pub type Rheologies = std::sync::Arc<[Box<dyn sph_rheology::Rheology>]>;
