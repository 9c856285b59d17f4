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
#[derive(Copy, Default)]
pub struct SymplecticEuler(pub LimitCoefficients);

impl Integrator for SymplecticEuler {
    fn coefficients(&self) -> LimitCoefficients {
        self.0
    }

    fn kicks_once(&self) -> bool {
        true
    }

    fn step(&mut self, system: &mut dyn System, dt: f64) -> Result<(), StepError> {
        system.kick(dt)?;
        system.drift(dt)
    }
}
