//! Schemes of friction over a step.

use sph_core::{contract, parameters, plugin};

/// Convergence of the viscosity with the new velocity, where it depends on it.
#[parameters]
pub struct OuterIteration {
    /// Iterate until √(Σm|Δu|²/Σm(|u|² + Δt²|g|²)) is below this, with the driving acceleration g.
    #[parameter(default: 1e-4, unit: "1", min: 0.0, source: "ours")]
    pub tolerance: f64,
    /// Largest number of solves per step; 1 takes the viscosity of the step before.
    #[parameter(default: 30, unit: "1", min: 1, source: "ours")]
    pub iterations: usize,
}

/// M (uⁿ⁺¹ − uⁿ)/Δt = F − θ K uⁿ⁺¹ − (1 − θ) K uⁿ, with the friction K and all other forces F.
///
/// Where K depends on the velocity, it is that of the last but one iterate (Picard).
pub trait TimeScheme: Send {
    /// θ.
    fn implicit_share(&self) -> f64;
    /// When a viscosity that follows the velocity is good enough.
    fn outer(&self) -> OuterIteration;
}

contract!(
    /// An implicit treatment of viscosity that a scene may name.
    pub ImplicitViscosityEntry, "implicit-viscosity", One, "friction from the end of the step: no viscous bound on it",
    TimeScheme, .absent("explicit if left out")
);

/// θ = 1: first order, damps all modes for any Δt.
///
/// Source: Ghaïtanellis 2017, Eq. 5.3–5.6.
///
/// ```toml
/// [implicit-viscosity.backward-euler]
/// ```
#[plugin(ImplicitViscosityEntry, "backward-euler", "first order, damps every mode however large the step",
    source: "Ghaïtanellis 2017, §5.1.1")]
#[derive(Copy)]
pub struct BackwardEuler {
    /// Convergence of the viscosity, where it depends on the velocity.
    #[parameter(default)]
    pub picard: OuterIteration,
}

impl TimeScheme for BackwardEuler {
    fn implicit_share(&self) -> f64 {
        1.0
    }
    fn outer(&self) -> OuterIteration {
        self.picard
    }
}

/// θ = 1/2: second order, where the integrator is and viscosities do not follow the velocity (then first); stable for any Δt, but modes that are much faster
/// than the step change their sign instead of dying away.
///
/// Source: Crank & Nicolson 1947.
///
/// ```toml
/// [integrator.leap-frog]
/// [implicit-viscosity.crank-nicolson]
/// ```
#[plugin(ImplicitViscosityEntry, "crank-nicolson", "second order with an integrator of second order",
    source: "Crank & Nicolson 1947")]
#[derive(Copy)]
pub struct CrankNicolson {
    /// Convergence of the viscosity, where it depends on the velocity.
    #[parameter(default)]
    pub picard: OuterIteration,
}

impl TimeScheme for CrankNicolson {
    fn implicit_share(&self) -> f64 {
        0.5
    }
    fn outer(&self) -> OuterIteration {
        self.picard
    }
}
