//! Settling and mixing of grains, as a scene gives it.

use sph_core::parameters;

use super::hindered::HinderedSettling;
use crate::sediment::Grains;

/// The speed at which one grain settles in still fluid.
#[parameters]
pub enum SettlingLaw {
    /// ν/d (√(10.36² + 1.049 D*³) − 10.36): sand in water.
    #[default]
    Soulsby,
    /// (s − 1) g d²/(18 ν): small spheres.
    Stokes,
}

/// The concentration in a body at the start.
#[parameters]
pub struct BodyConcentration {
    /// Name of the body.
    pub body: String,
    /// Volume of grains per volume.
    #[parameter(unit: "1", min: 0.0)]
    pub concentration: f64,
}

/// Grains of one size in a fluid: how they settle and mix.
#[parameters]
pub struct Suspended {
    /// Diameter d of the grains; that of the law of bed load if left out.
    #[parameter(unit: "m", above: 0.0)]
    pub grain_diameter: Option<f64>,
    /// Their density; that of the law of bed load if left out, 2650 kg/m³ without one.
    #[parameter(unit: "kg/m³", above: 0.0)]
    pub grain_density: Option<f64>,
    /// The speed at which one grain settles.
    #[parameter(default, source: "Soulsby 1997, Eq. 102; Stokes 1851")]
    pub settling: SettlingLaw,
    /// That speed, if it is known.
    #[parameter(unit: "m/s", min: 0.0)]
    pub settling_velocity: Option<f64>,
    /// Exponent n of w (1 − C)^n; that of Richardson and Zaki for the grain's Reynolds number if left out.
    #[parameter(unit: "1", min: 0.0, source: "Richardson and Zaki 1954")]
    pub hindrance_exponent: Option<f64>,
    /// Concentration of packed grains; 1 − n of the bed if left out, 0.6 without one.
    #[parameter(unit: "1", above: 0.0, max: 1.0)]
    pub packing: Option<f64>,
    /// Viscosity of the eddies over the diffusivity of the grains.
    #[parameter(default: 1.0, unit: "1", above: 0.0, source: "Rouse 1937")]
    pub schmidt_number: f64,
    /// Diffusivity of the grains without eddies.
    #[parameter(default: 0.0, unit: "m²/s", min: 0.0)]
    pub diffusivity: f64,
    /// Height over the bed at which grains leave it and come back to it; two grains if left out.
    #[parameter(unit: "m", above: 0.0, source: "Zyserman and Fredsøe 1994")]
    pub reference_height: Option<f64>,
    /// Concentrations of bodies at the start; none if left out.
    #[parameter(default)]
    pub start: Vec<BodyConcentration>,
}

impl Suspended {
    /// Concentration of packed grains: that of the scene, else `packing`.
    pub fn packed(&self, packing: f64) -> f64 {
        self.packing.unwrap_or(packing)
    }

    /// Settling of the grains; `packing` is the concentration of packed grains unless the scene gives it.
    #[must_use]
    pub fn settles(&self, grains: &Grains, packing: f64) -> HinderedSettling {
        let of_law = match self.settling {
            SettlingLaw::Soulsby => grains.settling_velocity(),
            SettlingLaw::Stokes => grains.stokes_velocity(),
        };
        let speed = self.settling_velocity.unwrap_or(of_law);
        let reynolds = speed * grains.diameter / grains.viscosity;
        let exponent = self.hindrance_exponent;
        HinderedSettling {
            speed,
            exponent: exponent.unwrap_or_else(|| HinderedSettling::exponent_of(reynolds)),
            packing: self.packed(packing),
        }
    }
}
