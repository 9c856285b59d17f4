//! The law of Hertz and Mindlin.

use serde::Serialize;
use sph_core::plugin;

use crate::grains::law::{AT_LEAST_0, BELOW_1, check, reduced};
use crate::grains::{
    Contact, ContactLaw, ContactLawEntry, GrainError, RollingResistance, Stiffness,
};

/// F_n = (4/3) E* √R* δ^{3/2} − c_n v_n and ΔF_s = −k_t Δu_s with k_t = 4 G √(R* δ) / (2 − ν), |F_s| ≤ µ F_n.
///
/// E* = G / (1 − ν) (Pa) and R* the reduced radius (m); a wall is flat and of the same material. This is
/// Catalano's Eqs. (2.10), (2.11), whose R is 2 R*. When the contact unloads, F_s shrinks with k_t, for a
/// tangent stiffness alone would give back more than was put in (Elata & Berryman 1996; Thornton,
/// Cummins & Cleary 2011). c_n = √5 ζ √(m* k_H) δ^¼ with k_H = (4/3) E* √R*, which rebounds at
/// e = exp(−π ζ / √(1 − ζ²)) at any speed (Antypov & Elliott 2011).
#[plugin(
    ContactLawEntry,
    "hertz-mindlin",
    "Hertz's normal force and Mindlin's tangential stiffness with Coulomb friction",
    source: "Catalano 2012, Eqs. (2.10), (2.11)"
)]
#[derive(Copy, PartialEq, Serialize)]
pub struct HertzMindlin {
    /// Shear modulus G of the grains.
    #[parameter(unit: "Pa", above: 0.0)]
    pub shear_modulus: f64,
    /// Poisson's ratio ν of the grains.
    #[parameter(unit: "1", above: -1.0, max: 0.5)]
    pub poisson: f64,
    /// Coefficient of friction µ = tan φ_c.
    #[parameter(unit: "1", min: 0.0)]
    pub friction: f64,
    /// ζ of the dashpots, normal and, while nothing slides, tangential.
    #[parameter(default, unit: "1", min: 0.0, below: 1.0)]
    pub damping: f64,
    /// Resistance to rolling.
    #[parameter(default)]
    pub rolling: Option<RollingResistance>,
}

const NAME: &str = "hertz-mindlin";

impl HertzMindlin {
    /// Springs and friction, without dashpots or resistance to rolling.
    pub fn new(shear_modulus: f64, poisson: f64, friction: f64) -> Self {
        Self {
            shear_modulus,
            poisson,
            friction,
            damping: 0.0,
            rolling: None,
        }
    }

    /// E* = G / (1 − ν), Pa.
    pub fn contact_modulus(&self) -> f64 {
        self.shear_modulus / (1.0 - self.poisson)
    }

    /// k_t = 4 G √(R* δ) / (2 − ν), N/m, from √(R* δ).
    fn tangential(&self, disc: f64) -> f64 {
        4.0 * self.shear_modulus * disc / (2.0 - self.poisson)
    }
}

impl ContactLaw for HertzMindlin {
    fn check(&self) -> Result<(), GrainError> {
        let poisson = self.poisson > -1.0 && self.poisson <= 0.5;
        check(
            NAME,
            [
                (
                    "shear modulus",
                    self.shear_modulus,
                    "positive",
                    self.shear_modulus > 0.0,
                ),
                (
                    "Poisson's ratio",
                    self.poisson,
                    "above -1 and at most 0.5",
                    poisson,
                ),
                ("friction", self.friction, AT_LEAST_0, self.friction >= 0.0),
                (
                    "damping",
                    self.damping,
                    BELOW_1,
                    (0.0..1.0).contains(&self.damping),
                ),
            ],
        )?;
        self.rolling.map_or(Ok(()), |rolling| rolling.check(NAME))
    }

    fn memory(&self) -> &'static [&'static str] {
        let all = &["F_sx", "F_sy", "F_sz", "k_t", "M_x", "M_y", "M_z"];
        &all[..if self.rolling.is_some() { 7 } else { 4 }]
    }

    fn respond(&self, contacts: &mut [Contact]) {
        for contact in contacts {
            let disc = (contact.reduced_radius() * contact.overlap).sqrt();
            let mut normal = 4.0 / 3.0 * self.contact_modulus() * disc * contact.overlap;
            let kt = self.tangential(disc);
            let approach = contact.velocity.dot(&contact.normal);
            let sliding = contact.velocity - contact.normal * approach;
            let mut shear = contact.carried(contact.remembered(0));
            if kt < contact.memory[3] {
                shear *= kt / contact.memory[3];
            }
            shear -= sliding * (kt * contact.step);
            let mut total = shear;
            if self.damping > 0.0 {
                // √5 √k_H δ^¼ = 2 √(5/6) √(∂F_n/∂δ).
                let factor = 2.0 * (5.0_f64 / 6.0).sqrt() * self.damping;
                let mass = contact.reduced_mass();
                normal -= factor * (mass * 2.0 * self.contact_modulus() * disc).sqrt() * approach;
                total -= sliding * (factor * (mass * kt).sqrt());
            }
            let limit = self.friction * normal.max(0.0);
            let size = total.norm();
            if size > limit {
                total *= limit / size;
                shear = total;
            }
            contact.remember(0, shear);
            contact.memory[3] = kt;
            contact.force = contact.normal * normal + total;
            if let Some(rolling) = &self.rolling {
                rolling.act(contact, 4, normal, kt);
            }
        }
    }

    fn friction(&self) -> f64 {
        self.friction
    }

    fn stiffness(&self, radius: [f64; 2], overlap: f64) -> Stiffness {
        let radius = reduced(radius);
        let disc = (radius * overlap).sqrt();
        let tangential = self.tangential(disc);
        let rolling = self.rolling.map(|r| r.stiffness(tangential, radius));
        Stiffness {
            normal: 2.0 * self.contact_modulus() * disc,
            tangential,
            rolling: rolling.unwrap_or(0.0),
            damping: self.damping,
        }
    }
}
