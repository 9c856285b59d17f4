//! Seepage by the law of Darcy and Forchheimer.

use sph_contribution::{Contribution, Offer, Refusal, Setting};
use sph_core::{fields, plugin};

use crate::seepage::pore_water::Seeps;
use crate::seepage::{Exchange, Phase, PoreResistance, SeepageEntry};
use crate::stress::conjugate_gradient;

/// C q̇ + a q + b |q| q = −∇p + ρ_w (g − Du_s/Dt), div q = 0 in the soil.
///
/// Symbols: q flux of the water relative to the grains (m/s); p its pressure (Pa); ρ_w its density; u_s the velocity of the soil;
/// a = η/k; b and k from the grains (Kozeny–Carman and Ergun) or as given; C = ρ_w/n (1 + κ(1 − n)/n) the inertia of
/// the water in the pores. The porosity n of a soil is constant: what comes in at one side leaves at another, and where the soil
/// meets the water, mass and its momentum go from water particles to water particles.
///
/// Σ_b Q_ab = 0 is solved for the pressures in the soil, those of the water beside it being given:
/// Q_ab = −2 V_aV_b F_ab/γ_ab m/λ [p_a − p_b − (f + λ C q/Δt)·r_ab], with m = 1/(C/Δt + a + b|q|), f = ρ_w(g − Du/Dt) along
/// the way and λ its share in the soil (1 between two particles of soil). The inertia makes the water in the pores a wave slower than sound:
/// no further bound on the step. Limits: constant porosity, saturated; the momentum ρ_w q of the relative motion is not counted; water particles that give or take
/// more than their neighbours can even out end the run ([`size_limit`](DarcyForchheimer::size_limit)).
///
/// Source: Forchheimer 1901; Ergun 1952; van Gent 1995; the sums are ours.
///
/// ```toml
/// [seepage.darcy-forchheimer]
/// soil = "beads"
/// water = "water"
/// porosity = 0.4
/// grain_diameter = "2 mm"
/// ```
#[plugin(SeepageEntry [2, 3], "darcy-forchheimer",
    "water seeps through a soil of constant porosity, driven by its pressure, gravity and acceleration",
    source: "Ergun 1952; van Gent 1995", cfg(not(test)))]
pub struct DarcyForchheimer {
    /// Name of the phase with the pores.
    pub soil: String,
    /// Name of the phase in the pores and around.
    pub water: String,
    /// Porosity n: share of the pores in the volume of the soil.
    #[parameter(unit: "1", above: 0.0, below: 1.0)]
    pub porosity: f64,
    /// Diameter d of the grains; may be left out where `permeability` and `forchheimer` are given.
    #[parameter(unit: "m", above: 0.0)]
    pub grain_diameter: Option<f64>,
    /// Permeability k; n³d²/(150 (1 − n)²) if left out.
    #[parameter(unit: "m²", above: 0.0, source: "Ergun 1952")]
    pub permeability: Option<f64>,
    /// Coefficient b of |q| q; 1.75 ρ_w (1 − n)/(n³d) if left out, 0 for Darcy's law.
    #[parameter(unit: "kg/m⁴", min: 0.0, source: "Ergun 1952")]
    pub forchheimer: Option<f64>,
    /// Viscosity η of the water in the pores.
    #[parameter(default: 1e-3, unit: "Pa s", above: 0.0, source: "water of 20 °C")]
    pub viscosity: f64,
    /// Share κ of the water that grains displace which moves with the water around them.
    #[parameter(default: 0.34, unit: "1", min: 0.0, source: "van Gent 1995")]
    pub added_mass: f64,
    /// Strength χ at which water particles of different size even out: they diffuse with χ c h. 0 for not at all.
    #[parameter(default: 0.15, unit: "1", min: 0.0, max: 0.2, source: "ours")]
    pub evening: f64,
    /// Share of its size that a water particle may give or take before the run ends.
    #[parameter(default: 0.5, unit: "1", above: 0.0, below: 1.0, source: "ours")]
    pub size_limit: f64,
    /// Relative residual at which the iteration for the pressures ends.
    #[parameter(default: 1e-8, unit: "1", above: 0.0, max: 0.1, source: "ours")]
    pub tolerance: f64,
    /// Iterations after which it gives up; the step is then tried again with half its length.
    #[parameter(default: 2000, unit: "1", min: 1, source: "ours")]
    pub iterations: usize,
}

impl DarcyForchheimer {
    /// The resistance to water of a density, kg/m³.
    ///
    /// # Errors
    /// If the diameter of the grains is needed and missing.
    pub fn resistance(&self, density: f64) -> Result<PoreResistance, Refusal> {
        let of_grains = |given: Option<f64>, rule: &dyn Fn(f64) -> f64| {
            let rule = || self.grain_diameter.map(rule);
            given.or_else(rule).ok_or_else(|| {
                let why = "the resistance follows from the diameter of the grains: give \
                           `grain_diameter`, or both `permeability` and `forchheimer`";
                Refusal::at_key(KIND, "", why)
            })
        };
        let n = self.porosity;
        let permeability = of_grains(self.permeability, &|d| PoreResistance::permeability(n, d))?;
        Ok(PoreResistance {
            linear: self.viscosity / permeability,
            quadratic: of_grains(self.forchheimer, &|d| PoreResistance::eddies(n, d, density))?,
            inertia: PoreResistance::inertia(n, self.added_mass, density),
        })
    }
}

const KIND: &str = "seepage";

impl<const D: usize> Contribution<D> for DarcyForchheimer {
    fn offer(&mut self, setting: &Setting<'_, D>, offer: &mut Offer<D>) -> Result<(), Refusal> {
        if setting.density.value != fields::DENSITY_CONSTANT {
            let why = "particles give and take mass, which is known with densities that are sums over positions: take \
                       [formulation.hu-adams]";
            return Err(Refusal::at_key(KIND, "", why));
        }
        let soil = setting.phase_number(KIND, "soil", &self.soil)?;
        let phase = Phase::new(setting, KIND, soil, &self.water)?;
        offer.hook(Seeps {
            resistance: self.resistance(phase.density)?,
            phase,
            solver: conjugate_gradient(self.tolerance, self.iterations),
            exchange: Exchange {
                evening: self.evening,
                limit: self.size_limit,
                remedy: "raise `evening` or `size_limit` of [seepage], or take a finer spacing",
            },
            density: setting.density.value,
            earlier: Vec::new(),
        });
        Ok(())
    }
}
