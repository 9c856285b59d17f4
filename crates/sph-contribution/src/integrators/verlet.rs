//! The Verlet scheme of Kajtar and Monaghan: drift, kick, drift.

use sph_core::{Recall, StepError, System, plugin};

use crate::integrators::{Integrator, IntegratorEntry, LimitCoefficients};

/// rⁿ⁺½ = rⁿ + Δt/2 uⁿ, uⁿ⁺¹ = uⁿ + Δt a(rⁿ⁺½, uⁿ + Δt/2 aⁿ), rⁿ⁺¹ = rⁿ⁺½ + Δt/2 uⁿ⁺¹.
///
/// Second order, also with friction; symplectic without. Two evaluations per step: the second one
/// at the middle, the first for the friction there. Undamped oscillations are stable up to
/// ωΔt = 2, friction up to λΔt = 2; on a lattice with h = 2δr that is c₀Δt/h ≈ 1.7 and
/// νΔt/h² ≈ 0.29.
///
/// Source: Kajtar & Monaghan 2010 (who take the friction's velocity from the step before);
/// Monaghan 2005.
///
/// ```toml
/// [integrator.verlet]
/// courant = 0.4
/// ```
#[plugin(IntegratorEntry, "verlet", "drift, kick, drift: second order, two evaluations per step",
    source: "Kajtar & Monaghan 2010; Monaghan 2005")]
pub struct Verlet {
    /// Share of the time sound takes over h: Δt ≤ courant · h / c.
    #[parameter(default: 0.4, unit: "1", above: 0.0, max: 1.7, source: "Kajtar & Monaghan 2010")]
    pub courant: f64,
    /// Share of the viscous time over h: Δt ≤ viscous · ρ h² / η.
    #[parameter(default: 0.125, unit: "1", above: 0.0, max: 0.3, source: "Kajtar & Monaghan 2010")]
    pub viscous: f64,
    /// Share of the time the largest acceleration takes over h: Δt ≤ force · √(h / |a|).
    #[parameter(default: 0.25, unit: "1", above: 0.0, max: 1.0, source: "Monaghan 1992")]
    pub force: f64,
}

impl Integrator for Verlet {
    fn coefficients(&self) -> LimitCoefficients {
        LimitCoefficients {
            courant: self.courant,
            viscous: self.viscous,
            force: self.force,
        }
    }

    fn step(&mut self, system: &mut dyn System, dt: f64) -> Result<(), StepError> {
        system.drift(0.5 * dt)?;
        system.keep()?;
        system.kick(0.5 * dt)?;
        system.evaluate()?;
        system.recall(Recall::Motion)?;
        system.kick(dt)?;
        system.drift(0.5 * dt)
    }
}
