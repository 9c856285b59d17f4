//! How constitutive laws meet particles.
//!
//! * [`VelocityGradient`] is a kind of plugin: ∂u_i/∂x_j from a particle's neighbours and walls.
//!   [`GradientStage`] applies it, [`StrainRate`] takes the magnitude.
//! * [`ViscosityStage`] hands batches of particles to their phase's law.
//! * [`ElasticMotion`] carries remembered stresses along, [`CarriedStress`] tells what of them acts,
//!   and [`StressDivergence`] is the force.
//!
//! Nothing here runs in a scene whose laws do not ask for it.

mod batches;
mod carried;
mod divergence;
mod elastic;
mod gradient;
mod isotropic;
mod renormalised;
mod strain_rate;
mod symmetric_difference;
mod viscosity;
mod wave_limit;

pub use carried::CarriedStress;
pub use divergence::StressDivergence;
pub use elastic::ElasticMotion;
pub use gradient::{GradientStage, NeighbourSums, VelocityGradient, VelocityGradientEntry};
pub use isotropic::Isotropic;
pub use renormalised::Renormalised;
pub use strain_rate::StrainRate;
pub use symmetric_difference::SymmetricDifference;
pub use viscosity::ViscosityStage;
pub use wave_limit::ElasticWaveLimit;

/// The laws of a scene, in the order of the phase numbers.
pub type Rheologies = std::sync::Arc<[Box<dyn sph_rheology::Rheology>]>;
