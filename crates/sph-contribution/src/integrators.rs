//! Time integrators as plugins over [`sph_core::System`], and the coefficients of their limits: symplectic Euler, Verlet,
//! leap-frog, and a predictor–corrector.
//!
//! An [`Integrator`] consists of kicks, drifts and evaluations, without particles.

#[cfg(test)]
mod trial;

use sph_core::{Recall, StepError, System, contract, parameters, plugin};

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
