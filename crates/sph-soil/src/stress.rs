//! Stresses of particles by constitutive laws.
//!
//! * [`VelocityGradient`] is a kind of plugin: ∂u_i/∂x_j from a particle's neighbours and walls.
//!   [`GradientStage`] applies it, `strain_rate` takes the magnitude, also within the sweep.
//! * `law_stages` hands batches of particles to their phase's law: viscosities, the acting part of remembered stresses, and
//!   how the forces share where a material yields.
//! * [`ElasticMotion`] carries remembered stresses along.
//! * [`ElasticForce`] is a kind of plugin: [`Divergence`] takes [`StressDivergence`] or [`AdjointDivergence`] of the stress,
//!   [`Displacement`] second differences of the way since the material was last liquid. [`Blended`] weighs forces,
//!   and [`ElasticSubSteps`] gives a force steps of its own.
//! * [`Laplace`] is an effective pressure ([`EffectivePressureEntry`]): that between the grains, where it is not that
//!   of the equation of state.
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

pub use adjoint::AdjointDivergence;
pub use blended::Blended;
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
pub(crate) use laplace::conjugate_gradient;
pub use laplace::{EffectivePressureEntry, Laplace, PressureSolver, Soils};
pub use law_inputs::{Blend, LawInputs};
pub use strain_rate::GradientStage;

/// The laws of a scene, in the order of the phase numbers.
pub type Rheologies = std::sync::Arc<[Box<dyn sph_rheology::Rheology>]>;
