//! Leap-frog: kick, drift, kick.

use sph_core::{Recall, StepError, System, plugin};

use crate::integrators::{Integrator, IntegratorEntry, LimitCoefficients};

/// uⁿ⁺½ = uⁿ + Δt/2 aⁿ, rⁿ⁺¹ = rⁿ + Δt uⁿ⁺½, uⁿ⁺¹ = uⁿ⁺½ + Δt/2 a(rⁿ⁺¹, uⁿ + Δt aⁿ).
///
/// Second order, also with friction, for which it is Heun's scheme; symplectic without. Two
/// evaluations per step: the rates of a step's end are evaluated anew with the final velocity.
/// Undamped oscillations are stable up to ωΔt = 2, friction up to λΔt = 2.
///
/// Source: Verlet 1967; Springel 2005 (kick-drift-kick).
///
/// ```toml
/// [integrator.leap-frog]
/// courant = 0.4
/// ```
#[plugin(IntegratorEntry, "leap-frog", "kick, drift, kick: second order, two evaluations per step",
    source: "Verlet 1967; Springel 2005")]
#[derive(Copy, Default)]
pub struct LeapFrog(pub LimitCoefficients);

impl Integrator for LeapFrog {
    fn coefficients(&self) -> LimitCoefficients {
        self.0
    }

    fn step(&mut self, system: &mut dyn System, dt: f64) -> Result<(), StepError> {
        system.kick(0.5 * dt)?;
        system.drift(dt)?;
        system.keep()?;
        system.kick(0.5 * dt)?;
        system.evaluate()?;
        system.recall(Recall::Motion)?;
        system.kick(0.5 * dt)
    }
}
