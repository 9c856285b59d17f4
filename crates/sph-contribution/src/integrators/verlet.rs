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
#[derive(Copy, Default)]
pub struct Verlet(pub LimitCoefficients);

impl Integrator for Verlet {
    fn coefficients(&self) -> LimitCoefficients {
        self.0
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
