//! Time integrators as plugins over [`sph_core::System`], and the coefficients of their limits.
//!
//! An [`Integrator`] consists of kicks, drifts and evaluations, without particles.

mod schemes;
#[cfg(test)]
mod trial;

pub use schemes::{
    Integrator, IntegratorEntry, LeapFrog, LimitCoefficients, PredictorCorrector, SymplecticEuler,
    Verlet,
};
