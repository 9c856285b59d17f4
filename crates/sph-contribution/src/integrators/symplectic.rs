//! The symplectic Euler scheme of Ghaïtanellis (2017).

use sph_core::{StepError, System, plugin};

use crate::integrators::{Integrator, IntegratorEntry, LimitCoefficients};

/// uⁿ⁺¹ = uⁿ + Δt aⁿ, then rⁿ⁺¹ = rⁿ + Δt uⁿ⁺¹, then the density from the new positions.
///
/// First order, one evaluation per step, symplectic for a potential force. Undamped sound is
/// stable up to c₀Δt/h ≈ 1.7 on a lattice with h = 2δr; the thesis takes 0.4.
///
/// Source: Ghaïtanellis 2017, Eq. 2.102 and 2.103–2.107.
///
/// ```toml
/// [integrator.symplectic-euler]
/// courant = 0.4
/// ```
#[plugin(IntegratorEntry, "symplectic-euler",
    "kick, then drift with the new velocity; first order, one evaluation per step",
    source: "Ghaïtanellis 2017, Eq. 2.102")]
pub struct SymplecticEuler {
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

impl Integrator for SymplecticEuler {
    fn coefficients(&self) -> LimitCoefficients {
        LimitCoefficients {
            courant: self.courant,
            viscous: self.viscous,
            force: self.force,
        }
    }

    fn kicks_once(&self) -> bool {
        true
    }

    fn step(&mut self, system: &mut dyn System, dt: f64) -> Result<(), StepError> {
        system.kick(dt)?;
        system.drift(dt)
    }
}
