//! Time integrators as plugins over [`sph_core::System`], and the coefficients of their limits.
//!
//! An [`Integrator`] consists of kicks, drifts and evaluations, without particles.

mod contract;
mod schemes;
#[cfg(test)]
mod trial;

pub use contract::{Integrator, IntegratorEntry, LimitCoefficients};
pub use schemes::{LeapFrog, PredictorCorrector, SymplecticEuler, Verlet};
