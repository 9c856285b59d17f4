//! Time integrators as plugins over [`sph_core::System`], and the coefficients of their limits.
//!
//! An [`Integrator`] knows kicks, drifts and evaluations, and no particle.

mod contract;
mod symplectic;

pub use contract::{Integrator, IntegratorEntry, LimitCoefficients};
pub use symplectic::SymplecticEuler;
