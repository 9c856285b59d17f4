//! Resistance to rolling, a part of the contact laws.

use serde::Serialize;
use sph_core::parameters;

use crate::grains::law::{AT_LEAST_0, check};
use crate::grains::{Contact, GrainError};

/// An elastic moment against rolling that yields: ΔM = −k_r Δθ_t with k_r = β k_t R*², |M| ≤ η R* F_n.
///
/// Δθ_t is the tangential part of the relative rotation, R* the reduced radius, F_n the normal force. A
/// sphere stays on a slope up to tan θ = η. The moment turns with the contact; spin about the normal is free.
/// Source: Iwashita & Oda 1998; Ai, Chen, Rotter & Ooi 2011, model C.
#[parameters]
#[derive(PartialEq, Serialize)]
pub struct RollingResistance {
    /// η, the tangent of the angle of rolling resistance.
    #[parameter(unit: "1", min: 0.0)]
    pub coefficient: f64,
    /// β, stiffness over k_t R*².
    #[parameter(default: 1.0, unit: "1", above: 0.0)]
    pub stiffness: f64,
}

impl RollingResistance {
    pub(crate) fn check(&self, law: &'static str) -> Result<(), GrainError> {
        let (eta, beta) = (self.coefficient, self.stiffness);
        let of_eta = ("rolling coefficient", eta, AT_LEAST_0, eta >= 0.0);
        check(
            law,
            [of_eta, ("rolling stiffness", beta, "positive", beta > 0.0)],
        )
    }

    /// k_r, N m.
    pub(crate) fn stiffness(&self, tangential: f64, reduced_radius: f64) -> f64 {
        self.stiffness * tangential * reduced_radius * reduced_radius
    }

    /// Writes the couple; the moment is remembered from `first` on.
    pub(crate) fn act(&self, contact: &mut Contact, first: usize, normal: f64, tangential: f64) {
        let radius = contact.reduced_radius();
        let turn = contact.tangential(contact.spin) * contact.step;
        let old = contact.carried(contact.remembered(first));
        let mut moment = old - turn * self.stiffness(tangential, radius);
        let limit = self.coefficient * radius * normal.max(0.0);
        let size = moment.norm();
        if size > limit {
            moment *= limit / size;
        }
        contact.remember(first, moment);
        contact.couple = moment;
    }
}
