//! The μ(I) rheology of dense granular flow.

use crate::regularisation::saturation;
use crate::{Inputs, Needs, Rheology, parameters, plugin};

/// η = μ(I) p/γ̇ with μ = μ_s + (μ_2 − μ_s) I/(I + I_0) and the inertial number I = γ̇ t_i.
///
/// The inertial time is the longest of free fall, viscous and turbulent settling of a grain:
/// t_i = max(d√(ρ_g/p), η_w/p, d√(ρ_w C_D/p)). Dry grains need only the first. Pressures below
/// zero give no viscosity; where p is that of grains between which there is a fluid it must be the
/// effective one.
///
/// Symbols: p pressure (Pa), d grain diameter (m), ρ_g grain density, η_w, ρ_w, C_D viscosity,
/// density and drag coefficient of the fluid between the grains. Dense flow only, I below about
/// 0.3. The viscosity grows with the pressure: unless `largest_viscosity` is given the step is
/// bounded by the present state alone.
///
/// Source: Jop et al. 2006, as in Minatti & Paris 2015, Eq. 6–12, and Ghaïtanellis 2017,
/// Eq. 4.16–4.23 (its Eq. 4.16 prints the inverse of I).
///
/// ```toml
/// [phase.beads.rheology.mu-i]
/// static_friction = 0.3819
/// limiting_friction = 0.6435
/// reference_inertial_number = 0.279
/// grain_diameter = "0.5 mm"
/// grain_density = 2500
/// regularisation.minatti-paris = { yield_stress = "190 Pa", stress_growth = "1 s" }
/// ```
#[plugin(crate::RheologyEntry, "mu-i", "dense granular flow, friction by the inertial number",
    source: "Jop et al. 2006")]
#[derive(Copy)]
pub struct MuI {
    /// Friction coefficient μ_s of slow flow.
    #[parameter(unit: "1", above: 0.0, source: "Minatti & Paris 2015, Eq. 7")]
    pub static_friction: f64,
    /// Friction coefficient μ_2 of fast flow; not below μ_s, or μ_s counts.
    #[parameter(unit: "1", min: 0.0, source: "Minatti & Paris 2015, Eq. 7")]
    pub limiting_friction: f64,
    /// Inertial number I_0 half way between the two.
    #[parameter(unit: "1", above: 0.0, source: "Minatti & Paris 2015, Eq. 7")]
    pub reference_inertial_number: f64,
    /// Grain diameter d.
    #[parameter(unit: "m", above: 0.0, source: "Minatti & Paris 2015, Eq. 6")]
    pub grain_diameter: f64,
    /// Density ρ_g of the grains themselves.
    #[parameter(unit: "kg/m³", above: 0.0, source: "Minatti & Paris 2015, Eq. 6")]
    pub grain_density: f64,
    /// Viscosity η_w of the fluid between the grains.
    #[parameter(default, unit: "Pa s", min: 0.0, source: "Ghaïtanellis 2017, Eq. 4.16–4.23")]
    pub fluid_viscosity: f64,
    /// Density ρ_w of the fluid between the grains.
    #[parameter(default, unit: "kg/m³", min: 0.0, source: "Ghaïtanellis 2017, Eq. 4.16–4.23")]
    pub fluid_density: f64,
    /// Drag coefficient C_D of a grain in that fluid.
    #[parameter(default, unit: "1", min: 0.0, source: "Ghaïtanellis 2017, Eq. 4.16–4.23")]
    pub drag_coefficient: f64,
    /// Limit of the viscosity at rest: a table `chauchat-medale` (with `strain_rate`), `papanastasiou`
    /// (`stress_growth`) or `minatti-paris` (`yield_stress`, `stress_growth`).
    pub regularisation: MuIRegularisation,
    /// Bound of the viscosity from above; none if left out.
    #[parameter(unit: "Pa s", above: 0.0, source: "ours")]
    pub largest_viscosity: Option<f64>,
}

/// The viscosity of [`MuI`], made finite at γ̇ = 0.
///
/// | choice | η | at rest |
/// |---|---|---|
/// | `chauchat-medale` | μ(I) p/(γ̇ + m) | μ_s p/m |
/// | `papanastasiou` | η_0 + μ_s p (1 − e^(−mγ̇))/γ̇ | η_0 + μ_s p m |
/// | `minatti-paris` | μ(I) p/γ̇ [1 − μ_s/μ(I at p₀) e^(−m₀γ̇)] | μ_s p [m₀ + (μ_2/μ_s − 1) t_i(p₀)/I_0] |
///
/// η_0 = (μ_2 − μ_s) p/(γ̇ + I_0/t_i) is what μ(I) p/γ̇ has besides μ_s p/γ̇.
///
/// `minatti-paris` is a Papanastasiou growth whose m depends on the pressure, so that the relative
/// error of the viscosity is at every pressure what it is at p₀ = τ₀/μ_s. The source integrates
/// dm/dτ_y approximately; this is the exact solution (ours).
///
/// Sources: Chauchat & Médale 2014, in Ghaïtanellis 2017, Eq. 4.16–4.23; Minatti & Paris 2015,
/// Eq. 45–55.
#[parameters]
#[derive(PartialEq)]
#[cfg_attr(feature = "plugins", derive(serde::Serialize))]
pub enum MuIRegularisation {
    /// A strain rate is added in the denominator.
    ChauchatMedale {
        /// Strain rate m.
        #[parameter(unit: "1/s", above: 0.0, source: "Ghaïtanellis 2017, Eq. 4.16–4.23")]
        strain_rate: f64,
    },
    /// The yield stress grows like 1 − e^(−mγ̇).
    Papanastasiou {
        /// Stress growth time m.
        #[parameter(unit: "s", above: 0.0, source: "Minatti & Paris 2015, Eq. 48")]
        stress_growth: f64,
    },
    /// The same with a time that depends on the pressure.
    MinattiParis {
        /// Reference yield stress τ₀: the largest that is expected.
        #[parameter(unit: "Pa", above: 0.0, source: "Minatti & Paris 2015, Eq. 52")]
        yield_stress: f64,
        /// Stress growth time m₀ at that yield stress.
        #[parameter(unit: "s", above: 0.0, source: "Minatti & Paris 2015, Eq. 52")]
        stress_growth: f64,
    },
}

impl MuI {
    /// t_i at a positive pressure, s.
    pub fn inertial_time(&self, pressure: f64) -> f64 {
        let fluid = self.fluid_density * self.drag_coefficient;
        let heavier = self.grain_density.max(fluid);
        let fall = self.grain_diameter * (heavier / pressure).sqrt();
        fall.max(self.fluid_viscosity / pressure)
    }

    /// μ(I) at a strain rate and a positive pressure.
    pub fn friction(&self, strain_rate: f64, pressure: f64) -> f64 {
        self.static_friction + strain_rate * self.rise(strain_rate, pressure)
    }

    /// (μ_2 − μ_s)/(γ̇ + I_0/t_i), s: (μ − μ_s)/γ̇, also at rest.
    fn rise(&self, strain_rate: f64, pressure: f64) -> f64 {
        let range = (self.limiting_friction - self.static_friction).max(0.0);
        range / (strain_rate + self.reference_inertial_number / self.inertial_time(pressure))
    }

    /// η_0 = μ(I) p/γ̇ − μ_s p/γ̇ at a positive pressure, Pa s; also at rest.
    pub fn residual_viscosity(&self, strain_rate: f64, pressure: f64) -> f64 {
        pressure * self.rise(strain_rate, pressure)
    }

    /// η at a strain rate and a pressure, Pa s.
    pub fn at(&self, strain_rate: f64, pressure: f64) -> f64 {
        // Below that quotients overflow, and the viscosity is next to nothing.
        if pressure < 1e-200 {
            return 0.0;
        }
        let (p, gd, mu_s) = (pressure, strain_rate, self.static_friction);
        let eta = match self.regularisation {
            MuIRegularisation::ChauchatMedale { strain_rate: m } => {
                p * (self.friction(gd, p) / (gd + m))
            }
            MuIRegularisation::Papanastasiou { stress_growth: m } => {
                p * (self.rise(gd, p) + mu_s * m * saturation(m * gd))
            }
            MuIRegularisation::MinattiParis {
                yield_stress,
                stress_growth: m,
            } => {
                // [1 − μ_s/μ₀ e^(−mγ̇)]/γ̇ without the difference of two numbers near one.
                let there = yield_stress / mu_s;
                let bracket = self.rise(gd, there) + mu_s * m * saturation(m * gd);
                p * (self.friction(gd, p) / self.friction(gd, there)) * bracket
            }
        };
        self.largest_viscosity.map_or(eta, |most| eta.min(most))
    }
}

impl Rheology for MuI {
    fn slow_friction(&self) -> Option<f64> {
        Some(self.static_friction)
    }
    fn grain_diameter(&self) -> Option<f64> {
        Some(self.grain_diameter)
    }
    fn needs(&self) -> Needs {
        Needs {
            strain_rate: true,
            pressure: true,
        }
    }
    fn uniform_viscosity(&self) -> Option<f64> {
        None
    }
    fn viscosity(&self, inputs: &Inputs<'_>, viscosity: &mut [f64]) {
        for (k, eta) in viscosity.iter_mut().enumerate() {
            let (rate, pressure) = inputs.at(k);
            *eta = self.at(rate, pressure);
        }
    }
    /// Infinite unless a bound is given: at rest the viscosity is proportional to the pressure.
    fn largest_viscosity(&self) -> f64 {
        self.largest_viscosity.unwrap_or(f64::INFINITY)
    }
}
