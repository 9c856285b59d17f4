//! Time integrators as plugins over [`sph_core::System`], and the coefficients of their limits.
//!
//! An [`Integrator`] consists of kicks, drifts and evaluations, without particles.

mod contract;
mod leap_frog;
mod predictor_corrector;
mod symplectic;
#[cfg(test)]
mod trial;
mod verlet;

pub use contract::{Integrator, IntegratorEntry, LimitCoefficients};
pub use leap_frog::LeapFrog;
pub use predictor_corrector::PredictorCorrector;
pub use symplectic::SymplecticEuler;
pub use verlet::Verlet;
