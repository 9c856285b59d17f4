//! Contact laws: springs with friction, resistance to rolling.

use serde::Serialize;
use sph_core::{parameters, plugin};

use crate::grains::{Contact, ContactLaw, ContactLawEntry, GrainError, Stiffness, Vector, reduced};
use crate::{AT_LEAST_0, BELOW_1, require};

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
        let [r1, r2] = radius;
        let r2 = if r2.is_infinite() { r1 } else { r2 };
        2.0 * self.modulus * r1 * r2 / (r1 + r2)
    }
}

impl ContactLaw for LinearElastic {
    fn check(&self) -> Result<(), GrainError> {
        let (modulus, ratio) = (self.modulus, self.stiffness_ratio);
        let own = [
            ("modulus", modulus, "positive", modulus > 0.0),
            ("stiffness ratio", ratio, AT_LEAST_0, ratio >= 0.0),
        ];
        let shared = [self.friction, self.damping];
        check("linear-elastic", own, shared, self.rolling)
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
            let shear = contact.carried(contact.remembered(0)) - sliding * (kt * contact.step);
            let mut total = shear;
            if self.damping > 0.0 {
                let mass = contact.reduced_mass();
                normal -= 2.0 * self.damping * (mass * kn).sqrt() * approach;
                total -= sliding * (2.0 * self.damping * (mass * kt).sqrt());
            }
            slide(contact, normal, [shear, total], self.friction);
            roll(contact, normal, kt, self.rolling, 3);
        }
    }

    fn friction(&self) -> f64 {
        self.friction
    }

    fn stiffness(&self, radius: [f64; 2], _overlap: f64) -> Stiffness {
        let normal = self.normal_stiffness(radius);
        let tangential = self.stiffness_ratio * normal;
        Stiffness {
            normal,
            tangential,
            rolling: rolling(self.rolling, tangential, reduced(radius)),
            damping: self.damping,
        }
    }
}

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
        let (shear, poisson) = (self.shear_modulus, self.poisson);
        let fine = poisson > -1.0 && poisson <= 0.5;
        let own = [
            ("shear modulus", shear, "positive", shear > 0.0),
            ("Poisson's ratio", poisson, "above -1 and at most 0.5", fine),
        ];
        let shared = [self.friction, self.damping];
        check("hertz-mindlin", own, shared, self.rolling)
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
            slide(contact, normal, [shear, total], self.friction);
            contact.memory[3] = kt;
            roll(contact, normal, kt, self.rolling, 4);
        }
    }

    fn friction(&self) -> f64 {
        self.friction
    }

    fn stiffness(&self, radius: [f64; 2], overlap: f64) -> Stiffness {
        let radius = reduced(radius);
        let disc = (radius * overlap).sqrt();
        let tangential = self.tangential(disc);
        Stiffness {
            normal: 2.0 * self.contact_modulus() * disc,
            tangential,
            rolling: rolling(self.rolling, tangential, radius),
            damping: self.damping,
        }
    }
}

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

/// k_r, N m.
fn rolling(of: Option<RollingResistance>, tangential: f64, radius: f64) -> f64 {
    of.map_or(0.0, |of| of.stiffness * tangential * radius * radius)
}

/// Writes the couple of a resistance to rolling; the moment is remembered from `first` on.
fn roll(
    contact: &mut Contact,
    normal: f64,
    tangential: f64,
    of: Option<RollingResistance>,
    first: usize,
) {
    if let Some(RollingResistance { coefficient, .. }) = of {
        let radius = contact.reduced_radius();
        let turn = contact.tangential(contact.spin) * contact.step;
        let old = contact.carried(contact.remembered(first));
        let mut moment = old - turn * rolling(of, tangential, radius);
        cut(&mut moment, coefficient * radius * normal.max(0.0));
        contact.remember(first, moment);
        contact.couple = moment;
    }
}

/// Cuts a vector to a length; true if it was longer.
fn cut(vector: &mut Vector, limit: f64) -> bool {
    let size = vector.norm();
    let longer = size > limit;
    if longer {
        *vector *= limit / size;
    }
    longer
}

/// Writes the force of the normal one and of the springs' shear and the total one across, within friction.
fn slide(contact: &mut Contact, normal: f64, [shear, mut total]: [Vector; 2], friction: f64) {
    let slides = cut(&mut total, friction * normal.max(0.0));
    contact.remember(0, if slides { total } else { shear });
    contact.force = contact.normal * normal + total;
}

/// Checks the parameters of a law: two of its own by name, value, valid values and whether it is one of them, then
/// those that both laws have.
fn check(
    law: &str,
    own: [(&str, f64, &str, bool); 2],
    [friction, damping]: [f64; 2],
    rolling: Option<RollingResistance>,
) -> Result<(), GrainError> {
    let damped = (0.0..1.0).contains(&damping);
    let mut all = Vec::from(own);
    all.push(("friction", friction, AT_LEAST_0, friction >= 0.0));
    all.push(("damping", damping, BELOW_1, damped));
    if let Some(rolling) = rolling {
        let (eta, beta) = (rolling.coefficient, rolling.stiffness);
        all.push(("rolling coefficient", eta, AT_LEAST_0, eta >= 0.0));
        all.push(("rolling stiffness", beta, "positive", beta > 0.0));
    }
    all.into_iter().try_for_each(|(what, value, valid, fine)| {
        let what = format!("the contact law {law} has the {what}");
        Ok(require(what, value, valid, fine)?)
    })
}
