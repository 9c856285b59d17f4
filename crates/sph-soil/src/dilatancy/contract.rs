//! The kind of laws of dilatancy.

use sph_core::{Work, contract};

/// State of the grains at a point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GrainState {
    /// Volume φ of the grains per volume of the soil, 1.
    pub packing: f64,
    /// γ̇, 1/s.
    pub strain_rate: f64,
    /// Effective pressure p', Pa; not negative.
    pub pressure: f64,
}

/// Expansion of a soil by shear.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Dilation {
    /// Growth of the volume per volume, 1/s; negative where the soil contracts.
    pub rate: f64,
    /// Its derivative with respect to the effective pressure, 1/(Pa s); not positive.
    pub slope: f64,
}

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
