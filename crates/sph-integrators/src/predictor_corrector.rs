//! The predictor–corrector of Krimi et al. (2018).

use schemars::JsonSchema;
use serde::Deserialize;
use sph_core::{Recall, StepError, System, register};

use crate::{Integrator, IntegratorEntry, LimitCoefficients};

/// ũ = uⁿ + Δt aⁿ and r̃ = rⁿ + Δt uⁿ; then uⁿ⁺¹ = uⁿ + Δt/2 (aⁿ + ã) with ã from r̃, ũ and the old
/// density, and rⁿ⁺¹ = rⁿ + Δt uⁿ⁺¹, the density following.
///
/// The paper calls it second order. That is true of friction, for which it is Heun's scheme, stable
/// up to λΔt = 2. Sound sees the symplectic Euler scheme, since both accelerations have the same
/// pressure (the gradient is taken twice): first order, stable up to ωΔt = 2. Two evaluations of
/// the forces per step, one of the density.
///
/// Source: Krimi et al. 2018, Eq. 52–56.
///
/// ```toml
/// [integrator.predictor-corrector]
/// courant = 0.25
/// ```
#[derive(Clone, Copy, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct PredictorCorrector {
    /// Share of the time sound takes over h: Δt ≤ courant · h / c.
    #[schemars(
        range(max = 1.7),
        extend("exclusiveMinimum" = 0.0, "unit" = "1", "source" = "Krimi et al. 2018, Eq. 54–56")
    )]
    pub courant: f64,
    /// Share of the viscous time over h: Δt ≤ viscous · ρ h² / η.
    #[schemars(
        range(max = 0.3),
        extend("exclusiveMinimum" = 0.0, "unit" = "1", "source" = "Krimi et al. 2018, Eq. 54–56")
    )]
    pub viscous: f64,
    /// Share of the time the largest acceleration takes over h: Δt ≤ force · √(h / |a|).
    #[schemars(
        range(max = 1.0),
        extend("exclusiveMinimum" = 0.0, "unit" = "1", "source" = "Monaghan 1992")
    )]
    pub force: f64,
}

impl Default for PredictorCorrector {
    fn default() -> Self {
        PredictorCorrector {
            courant: 0.25,
            viscous: 0.2,
            force: 0.25,
        }
    }
}

impl Integrator for PredictorCorrector {
    fn coefficients(&self) -> LimitCoefficients {
        LimitCoefficients {
            courant: self.courant,
            viscous: self.viscous,
            force: self.force,
        }
    }

    fn step(&mut self, system: &mut dyn System, dt: f64) -> Result<(), StepError> {
        system.keep()?;
        system.drift(dt)?;
        system.recall(Recall::Scalars)?;
        system.kick(dt)?;
        system.evaluate_forces()?;
        system.average_rates()?;
        system.recall(Recall::State)?;
        system.kick(dt)?;
        system.drift(dt)
    }
}

register!(
    IntegratorEntry,
    PredictorCorrector,
    "predictor-corrector",
    "friction of second order, sound of first; two evaluations of the forces",
    "Krimi et al. 2018, Eq. 52–56"
);

#[cfg(test)]
mod tests {
    use super::*;
    use crate::trial::Promise;

    #[test]
    fn orders_stability_and_energy_are_as_stated() {
        let promise = Promise {
            sound: 1.0,
            both: 1.0,
            friction: 2.0,
            stable: 2.0,
            energy: 0.06,
        };
        promise.check(&mut PredictorCorrector::default());
    }
}
