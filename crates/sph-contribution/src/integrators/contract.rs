//! The trait of time integrators.

use sph_core::{StepError, System, contract, parameters};

/// The part of each physical time scale that one step may take.
#[parameters]
#[derive(Copy, PartialEq)]
pub struct LimitCoefficients {
    /// Share of the time sound takes over h: Δt ≤ courant · h / c.
    #[parameter(default: 0.4, unit: "1", above: 0.0, max: 1.7, source: "Ghaïtanellis 2017, Eq. 2.104")]
    pub courant: f64,
    /// Share of the viscous time over h: Δt ≤ viscous · ρ h² / η.
    #[parameter(default: 0.125, unit: "1", above: 0.0, max: 0.3, source: "Ghaïtanellis 2017, Eq. 2.106")]
    pub viscous: f64,
    /// Share of the time the largest acceleration takes over h: Δt ≤ force · √(h / |a|).
    #[parameter(default: 0.25, unit: "1", above: 0.0, max: 1.0, source: "Monaghan 1992")]
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
    /// On entry the rates belong to the present state; on exit the clock stands at t + dt and the rates may be stale.
    ///
    /// # Errors
    /// If an evaluation inside the step fails.
    fn step(&mut self, system: &mut dyn System, dt: f64) -> Result<(), StepError>;
}

contract!(
    /// An integrator that a scene may name.
    pub IntegratorEntry, "integrator", One, "the time stepping scheme", Integrator, .by_default("symplectic-euler")
);
