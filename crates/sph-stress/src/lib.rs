//! How constitutive laws meet particles.
//!
//! * [`VelocityGradient`] is a kind of plugin: ∂u_i/∂x_j from a particle's neighbours and walls.
//!   [`GradientStage`] applies it, [`StrainRate`] takes the magnitude.
//! * [`ViscosityStage`] hands batches of particles to their phase's law.
//! * [`ElasticMotion`] carries remembered stresses along, [`CarriedStress`] tells what of them acts,
//!   and [`StressDivergence`] or [`AdjointDivergence`] is the force.
//! * [`EffectivePressure`] is a kind of plugin: the pressure between the grains, where it is not that
//!   of the equation of state. [`Laplace`] is one.
//! * [`CoulombFriction`] brakes soils on walls that have a coefficient of friction.
//!
//! Nothing here runs in a scene whose laws do not ask for it.

mod adjoint;
mod carried;
mod coulomb;
mod divergence;
mod effective_pressure;
mod elastic;
mod felt;
mod gradient;
mod isotropic;
mod laplace;
mod renormalised;
mod soil_surface;
mod strain_rate;
mod symmetric_difference;
mod viscosity;
mod wave_limit;

pub use adjoint::{AdjointDivergence, StressCorrection};
pub use carried::CarriedStress;
pub use coulomb::CoulombFriction;
pub use divergence::StressDivergence;
pub use effective_pressure::{EffectivePressure, EffectivePressureEntry, Soils};
pub use elastic::ElasticMotion;
pub use felt::Felt;
pub use gradient::{GradientStage, NeighbourSums, VelocityGradient, VelocityGradientEntry};
pub use isotropic::Isotropic;
pub use laplace::Laplace;
pub use renormalised::Renormalised;
pub use strain_rate::StrainRate;
pub use symmetric_difference::SymmetricDifference;
pub use viscosity::ViscosityStage;
pub use wave_limit::ElasticWaveLimit;

/// The laws of a scene, in the order of the phase numbers.
pub type Rheologies = std::sync::Arc<[Box<dyn sph_rheology::Rheology>]>;
