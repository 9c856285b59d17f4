//! The kind of laws of dilatancy, and its plugins.

use sph_core::{Work, contract, plugin};

use super::critical_state::{CriticalState, Dilation, GrainState};

/// A law of dilatancy.
pub trait Dilatancy: Send + Sync {
    /// The expansion at a state.
    fn dilation(&self, state: &GrainState) -> Dilation;
    /// True if dilation adds friction to that of the rheology.
    fn adds_friction(&self) -> bool {
        false
    }
    /// The friction tan ψ that it adds, 1.
    fn friction(&self, _: &GrainState) -> f64 {
        0.0
    }
    /// Stiffness of the skeleton at an effective pressure, Pa, from that of its contacts.
    fn modulus(&self, contacts: f64, pressure: f64) -> f64;
    /// Packing that no state exceeds, 1.
    fn densest(&self) -> f64;
}

contract!(
    /// A law of dilatancy that a scene may name.
    pub DilatancyEntry, "dilatancy", One, "the change of a soil's packing by shear", Dilatancy,
    .absent("shear leaves the packing as it is if left out").ordered(121).works(Work::Others)
    .idle("shear changes a packing, which is a state of the pores: add [pore-pressure.darcy] or [pore-pressure.drained]")
);

/// Dilation adds tan ψ = K (φ − φ_eq) to the coefficient of friction, φ̇ = −φ γ̇ tan ψ.
///
/// The rheology sees the pressure p' (1 + tan ψ/μ), μ being its coefficient of slow flow, so that its strength is
/// (μ + tan ψ) p'. Limits: one packing for all directions of shear; ψ is not negative enough to leave no friction.
///
/// Source: Roux and Radjai 1998; Pailha and Pouliquen 2009.
///
/// ```toml
/// [dilatancy.roux-radjai]
/// critical_packing = 0.582
/// slope = 4.09
/// equilibrium.viscous = { viscosity = "96 mPa s" }
/// ```
#[plugin(DilatancyEntry, "roux-radjai", "tan ψ = K (φ − φ_eq), in the pores and in friction",
    source: "Roux and Radjai 1998; Pailha and Pouliquen 2009", cfg(not(test)))]
#[derive(Copy)]
pub struct RouxRadjai(pub CriticalState);

impl Dilatancy for RouxRadjai {
    fn dilation(&self, state: &GrainState) -> Dilation {
        self.0.dilation(state)
    }
    fn adds_friction(&self) -> bool {
        true
    }
    fn friction(&self, state: &GrainState) -> f64 {
        self.0.angle(state)
    }
    fn modulus(&self, contacts: f64, _: f64) -> f64 {
        contacts
    }
    fn densest(&self) -> f64 {
        self.0.densest_packing
    }
}

/// Dilation acts as a pressure of the grains alone: p' = E (φ/φ_pl − 1)^(3/2), φ̇_pl = −φ_pl γ̇ K (φ − φ_eq).
///
/// The plastic packing φ_pl is that at which grains lose contact. The stiffness of the skeleton follows as
/// 3/2 E (p'/E)^(1/3), with the `modulus` E of the pore pressure. Friction is that of the rheology, μ p'.
///
/// Source: after Montellà et al. 2021; the exponent is that of Hertz's contacts.
///
/// ```toml
/// [dilatancy.plastic-pressure]
/// critical_packing = 0.582
/// slope = 4.09
/// ```
#[plugin(DilatancyEntry, "plastic-pressure", "an elasto-plastic pressure of the grains",
    source: "after Montellà et al. 2021", cfg(not(test)))]
#[derive(Copy)]
pub struct PlasticPressure(pub CriticalState);

/// Share of E that is the least stiffness, where grains barely touch.
const LEAST_STIFFNESS: f64 = 1e-3;

impl Dilatancy for PlasticPressure {
    fn dilation(&self, state: &GrainState) -> Dilation {
        self.0.dilation(state)
    }
    fn modulus(&self, contacts: f64, pressure: f64) -> f64 {
        let share = 1.5 * (pressure.max(0.0) / contacts).cbrt();
        contacts * share.max(LEAST_STIFFNESS)
    }
    fn densest(&self) -> f64 {
        self.0.densest_packing
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// p' = E (φ/φ_pl − 1)^(3/2): its derivative over ln φ near φ_pl is the stiffness.
    #[test]
    fn the_stiffness_is_that_of_the_elastic_pressure() {
        let law = PlasticPressure(CriticalState {
            critical_packing: 0.58,
            slope: 4.0,
            equilibrium: crate::dilatancy::Equilibrium::Slow,
            densest_packing: 0.64,
        });
        let contacts = 1e7;
        let pressure = |excess: f64| contacts * f64::powf(excess, 1.5);
        let excess = 1e-4;
        let step = 1e-8;
        let difference = pressure(excess + step) - pressure(excess - step);
        let stiffness = law.modulus(contacts, pressure(excess));
        assert!((difference / (2.0 * step) / stiffness - 1.0).abs() < 1e-6);
    }
}
