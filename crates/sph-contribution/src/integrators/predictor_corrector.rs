//! The predictor–corrector of Krimi et al. (2018).

use sph_core::{Recall, StepError, System, plugin};

use crate::integrators::{Integrator, IntegratorEntry, LimitCoefficients};

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
#[plugin(IntegratorEntry, "predictor-corrector",
    "friction of second order, sound of first; two evaluations of the forces", source: "Krimi et al. 2018, Eq. 52–56")]
pub struct PredictorCorrector {
    /// Share of the time sound takes over h: Δt ≤ courant · h / c.
    #[parameter(default: 0.25, unit: "1", above: 0.0, max: 1.7, source: "Krimi et al. 2018, Eq. 54–56")]
    pub courant: f64,
    /// Share of the viscous time over h: Δt ≤ viscous · ρ h² / η.
    #[parameter(default: 0.2, unit: "1", above: 0.0, max: 0.3, source: "Krimi et al. 2018, Eq. 54–56")]
    pub viscous: f64,
    /// Share of the time the largest acceleration takes over h: Δt ≤ force · √(h / |a|).
    #[parameter(default: 0.25, unit: "1", above: 0.0, max: 1.0, source: "Monaghan 1992")]
    pub force: f64,
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
