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
pub struct LeapFrog {
    /// Share of the time sound takes over h: Δt ≤ courant · h / c.
    #[parameter(default: 0.4, unit: "1", above: 0.0, max: 1.7, source: "Springel 2005")]
    pub courant: f64,
    /// Share of the viscous time over h: Δt ≤ viscous · ρ h² / η.
    #[parameter(default: 0.125, unit: "1", above: 0.0, max: 0.3, source: "Springel 2005")]
    pub viscous: f64,
    /// Share of the time the largest acceleration takes over h: Δt ≤ force · √(h / |a|).
    #[parameter(default: 0.25, unit: "1", above: 0.0, max: 1.0, source: "Monaghan 1992")]
    pub force: f64,
}

impl Integrator for LeapFrog {
    fn coefficients(&self) -> LimitCoefficients {
        LimitCoefficients {
            courant: self.courant,
            viscous: self.viscous,
            force: self.force,
        }
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
