//! The linear elastic–frictional law.

use serde::Serialize;
use sph_core::plugin;

use crate::grains::law::{AT_LEAST_0, BELOW_1, check, reduced};
use crate::grains::{
    Contact, ContactLaw, ContactLawEntry, GrainError, RollingResistance, Stiffness,
};

/// F_n = k_n δ − c_n v_n and ΔF_s = −k_t Δu_s, |F_s| ≤ µ F_n.
///
/// k_n = 2 E R₁ R₂ / (R₁ + R₂) with the micro modulus E (Pa), k_t = a k_n (N/m); a wall takes the radius of the
/// grain, so k_n = E R there. δ is the overlap (m), u_s the tangential displacement at the contact point
/// (m), c = 2 ζ √(m* k) (N s/m) with the reduced mass m*. A pair rebounds at e = exp(−π ζ / √(1 − ζ²)) times
/// its speed; to hold this exactly the dashpot may pull just before the contact opens. Source: Catalano
/// 2012, Eqs. (2.8), (2.9), (2.12), (4.1), (4.2).
#[plugin(
    ContactLawEntry,
    "linear-elastic",
    "springs in the normal and the tangential direction with Coulomb friction",
    source: "Catalano 2012, Eqs. (2.8), (2.9), (2.12), (4.1), (4.2)"
)]
#[derive(Copy, PartialEq, Serialize)]
pub struct LinearElastic {
    /// Micro modulus E.
    #[parameter(unit: "Pa", above: 0.0)]
    pub modulus: f64,
    /// a = k_t / k_n.
    #[parameter(unit: "1", min: 0.0)]
    pub stiffness_ratio: f64,
    /// Coefficient of friction µ = tan φ_c.
    #[parameter(unit: "1", min: 0.0)]
    pub friction: f64,
    /// Ratio ζ of the dashpots to critical damping, normal and, while nothing slides, tangential.
    #[parameter(default, unit: "1", min: 0.0, below: 1.0)]
    pub damping: f64,
    /// Resistance to rolling.
    #[parameter(default)]
    pub rolling: Option<RollingResistance>,
}

const NAME: &str = "linear-elastic";

impl LinearElastic {
    /// Springs and friction, without dashpots or resistance to rolling.
    pub fn new(modulus: f64, stiffness_ratio: f64, friction: f64) -> Self {
        Self {
            modulus,
            stiffness_ratio,
            friction,
            damping: 0.0,
            rolling: None,
        }
    }

    /// k_n, N/m. Source: Catalano 2012, Eq. (4.1).
    pub fn normal_stiffness(&self, radius: [f64; 2]) -> f64 {
        let [r1, mut r2] = radius;
        if r2.is_infinite() {
            r2 = r1;
        }
        2.0 * self.modulus * r1 * r2 / (r1 + r2)
    }
}

impl ContactLaw for LinearElastic {
    fn check(&self) -> Result<(), GrainError> {
        check(
            NAME,
            [
                ("modulus", self.modulus, "positive", self.modulus > 0.0),
                (
                    "stiffness ratio",
                    self.stiffness_ratio,
                    AT_LEAST_0,
                    self.stiffness_ratio >= 0.0,
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
        &["F_sx", "F_sy", "F_sz", "M_x", "M_y", "M_z"][..if self.rolling.is_some() { 6 } else { 3 }]
    }

    fn respond(&self, contacts: &mut [Contact]) {
        for contact in contacts {
            let kn = self.normal_stiffness(contact.radius);
            let kt = self.stiffness_ratio * kn;
            let approach = contact.velocity.dot(&contact.normal);
            let sliding = contact.velocity - contact.normal * approach;
            let mut normal = kn * contact.overlap;
            let mut shear = contact.carried(contact.remembered(0)) - sliding * (kt * contact.step);
            let mut total = shear;
            if self.damping > 0.0 {
                let mass = contact.reduced_mass();
                normal -= 2.0 * self.damping * (mass * kn).sqrt() * approach;
                total -= sliding * (2.0 * self.damping * (mass * kt).sqrt());
            }
            let limit = self.friction * normal.max(0.0);
            let size = total.norm();
            if size > limit {
                total *= limit / size;
                shear = total;
            }
            contact.remember(0, shear);
            contact.force = contact.normal * normal + total;
            if let Some(rolling) = &self.rolling {
                rolling.act(contact, 3, normal, kt);
            }
        }
    }

    fn friction(&self) -> f64 {
        self.friction
    }

    fn stiffness(&self, radius: [f64; 2], _overlap: f64) -> Stiffness {
        let normal = self.normal_stiffness(radius);
        let tangential = self.stiffness_ratio * normal;
        let radius = reduced(radius);
        let rolling = self.rolling.map(|r| r.stiffness(tangential, radius));
        Stiffness {
            normal,
            tangential,
            rolling: rolling.unwrap_or(0.0),
            damping: self.damping,
        }
    }
}
