//! The trait of time integrators.

use sph_core::{StepError, System, contract};

/// The part of each physical time scale that one step may take.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LimitCoefficients {
    /// Δt ≤ C h / c.
    pub courant: f64,
    /// Δt ≤ C ρ h² / η.
    pub viscous: f64,
    /// Δt ≤ C √(h / |a|).
    pub force: f64,
}

/// A scheme that advances the system by one step.
pub trait Integrator: Send {
    /// Its stable shares of the time scales.
    fn coefficients(&self) -> LimitCoefficients;
    /// True if a step is one kick over all of it and then one drift over all of it.
    fn kicks_once(&self) -> bool {
        false
    }
    /// Advances from t to t + dt.
    ///
    /// On entry the rates belong to the present state; on exit the clock stands at t + dt and
    /// the rates may be stale.
    ///
    /// # Errors
    /// If an evaluation inside the step fails.
    fn step(&mut self, system: &mut dyn System, dt: f64) -> Result<(), StepError>;
}

contract!(
    /// An integrator that a scene may name.
    pub IntegratorEntry, "integrator", One, "the time stepping scheme", Integrator, .by_default("symplectic-euler")
);
