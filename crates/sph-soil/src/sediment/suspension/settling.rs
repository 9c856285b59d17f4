//! Settling and mixing of grains: as a scene gives it, and among others.

use sph_core::parameters;

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

/// Speed and flux of grains of one size that settle in a fluid.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HinderedSettling {
    /// Speed w of one grain in still fluid, m/s.
    pub speed: f64,
    /// Exponent n.
    pub exponent: f64,
    /// Concentration C_max of packed grains.
    pub packing: f64,
}

impl HinderedSettling {
    /// n of grains with a Reynolds number wd/ν: 4.65 up to 0.2, 4.35 Re^−0.03 up to 1, 4.45 Re^−0.1 up to 500, 2.39 beyond, far
    /// from walls.
    ///
    /// Source: Richardson and Zaki 1954.
    pub fn exponent_of(reynolds: f64) -> f64 {
        match reynolds {
            re if re <= 0.2 => 4.65,
            re if re <= 1.0 => 4.35 * re.powf(-0.03),
            re if re <= 500.0 => 4.45 * re.powf(-0.1),
            _ => 2.39,
        }
    }

    /// w C (1 − C)^n, m/s: the volume of grains that passes a level per area and time.
    pub fn flux(&self, concentration: f64) -> f64 {
        self.speed * concentration * (1.0 - concentration).powf(self.exponent)
    }

    /// The concentration of the largest flux.
    pub fn fastest(&self) -> f64 {
        1.0 / (1.0 + self.exponent)
    }

    /// The flux that grains of a concentration send down where there is room, m/s.
    pub fn demand(&self, concentration: f64) -> f64 {
        self.flux(concentration.min(self.fastest()))
    }

    /// The flux that grains of a concentration let in from above, m/s: none where they are packed. Close to it w (C_max − C),
    /// so that a step that keeps concentrations from below zero keeps them below the packing, too.
    pub fn supply(&self, concentration: f64) -> f64 {
        let room = self.speed * (self.packing - concentration).max(0.0);
        self.flux(concentration.max(self.fastest()).min(1.0))
            .min(room)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn exponents_are_those_of_richardson_and_zaki() {
        let close = |re: f64, n: f64| (HinderedSettling::exponent_of(re) - n).abs() < 5e-3;
        assert!(close(0.01, 4.65) && close(1.0, 4.35) && close(100.0, 2.808) && close(1e4, 2.39));
    }

    /// min(demand above, supply below) is Godunov's flux: the least of f between C above and C below if C grows downwards, the
    /// largest otherwise.
    #[test]
    fn demand_and_supply_make_the_flux_of_godunov() {
        let law = HinderedSettling {
            speed: 2e-3,
            exponent: 4.65,
            packing: 0.6,
        };
        let levels = |a: f64, b: f64| (0..=2000).map(move |k| a + (b - a) * f64::from(k) / 2000.0);
        for (above, below) in [(0.0, 0.1), (0.1, 0.3), (0.3, 0.1), (0.05, 0.5), (0.5, 0.02)] {
            let flux = law.demand(above).min(law.supply(below));
            let all = levels(above, below).map(|c| law.flux(c));
            let godunov = match above <= below {
                true => all.fold(f64::INFINITY, f64::min),
                false => all.fold(0.0, f64::max),
            };
            assert!(
                (flux / godunov - 1.0).abs() < 1e-5 || godunov == 0.0,
                "{above} {below}"
            );
        }
        assert_eq!(law.supply(0.6), 0.0);
        assert_eq!(law.demand(0.0), 0.0);
    }
}
