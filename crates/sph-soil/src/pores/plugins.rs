//! The kind of models of the pores of a soil, and its plugins.

use std::collections::BTreeMap;

use sph_core::{Work, contract, parameters, plugin};

use crate::seepage::PoreResistance;

/// A porous wall behind which the fluid has an excess pressure.
#[parameters]
pub struct Supply {
    /// Name of the wall.
    pub wall: String,
    /// Excess pressure behind it.
    #[parameter(unit: "Pa")]
    pub excess: f64,
    /// Time over which that rises from 0 along a line; it is there from the start if this is 0.
    #[parameter(default, unit: "s", min: 0.0)]
    pub rise: f64,
}

impl Supply {
    /// Excess pressure at a time, Pa.
    pub fn at(&self, time: f64) -> f64 {
        match time < self.rise {
            true => self.excess * time / self.rise,
            false => self.excess,
        }
    }
}

/// Parameters of the pores of a soil.
#[derive(Clone, Debug)]
pub struct PoreSettings {
    /// Name of the phase with the pores.
    pub soil: String,
    /// Name of the phase that drains into the flow and comes from it.
    pub water: Option<String>,
    /// Porosity at the start.
    pub porosity: f64,
    /// Porosities of bodies of their own.
    pub bodies: BTreeMap<String, f64>,
    /// Density of the fluid that goes in and out, kg/m³; that of the water if `None`.
    pub fluid_density: Option<f64>,
    /// True if volumes of particles follow the packing.
    pub swelling: bool,
    /// The fluid that drains, and the skeleton that it drains from; `None` if the fluid passes freely.
    pub darcy: Option<Darcy>,
}

/// A model of the pores of a soil.
pub trait PoreModel: Send {
    /// Its parameters.
    fn settings(&self) -> PoreSettings;
}

contract!(
    /// A model of pores that a scene may name.
    pub PorePressureEntry, "pore-pressure", One, "the packing of a soil and the pressure in its pores", PoreModel,
    .absent("constant porosity, and pores at rest, if left out").ordered(122).works(Work::Others)
);

/// ∂ε/∂t = ∇·(k/η ∇p_e) = γ̇ tan ψ − (1/E) ∂p'/∂t, p' = p'_d − p_e, φ̇ = −φ ∂ε/∂t.
///
/// Symbols: p_e excess pressure of the pores (Pa), 0 at the surface of the soil, without flux into walls; ε growth of the volume
/// per volume; k permeability (m²), η viscosity of the fluid; E stiffness of the skeleton; p'_d effective pressure with
/// pores at rest, of `[effective-pressure.laplace]`; tan ψ of `[dilatancy.PLUGIN]`, 0 without one.
///
/// Backward Euler in time, so that k may be as small as one likes; conjugate gradients start from the last pressure. The flux between
/// two particles is the same for both, so that the volume of the grains and that of the fluid stay to rounding. The surface stands
/// beyond its particles at the distance that follows from the missing part of the kernel. A soil without `water` in the scene
/// drains into a fluid that is left out; one with it drains where the water touches it.
/// Limits: one soil; saturated; the fluid in the pores has no inertia; a particle that shrinks or grows stays round.
///
/// Source: Terzaghi 1943; Iverson and George 2014; Pailha and Pouliquen 2009; the sums are ours.
///
/// ```toml
/// [pore-pressure.darcy]
/// soil = "beads"
/// porosity = 0.42
/// grain_diameter = "160 µm"
/// viscosity = "96 mPa s"
/// ```
#[plugin(PorePressureEntry, "darcy", "packing as a state, excess pore pressure by Darcy's law",
    source: "Terzaghi 1943; Pailha and Pouliquen 2009", cfg(not(test)))]
pub struct Darcy {
    /// Name of the phase with the pores.
    pub soil: String,
    /// Name of the phase around the soil, which drains into its pores; a fluid that is left out if this is.
    pub water: Option<String>,
    /// Porosity n = 1 − φ of the soil at the start.
    #[parameter(unit: "1", above: 0.0, below: 1.0)]
    pub porosity: f64,
    /// Porosities of single bodies at the start, by the names of the bodies.
    #[parameter(default, unit: "1", above: 0.0, below: 1.0)]
    pub bodies: BTreeMap<String, f64>,
    /// Diameter d of the grains; may be left out where `permeability` is given.
    #[parameter(unit: "m", above: 0.0)]
    pub grain_diameter: Option<f64>,
    /// Permeability k at all packings; n³d²/(150 (1 − n)²) of the present porosity if left out.
    #[parameter(unit: "m²", above: 0.0, source: "Ergun 1952")]
    pub permeability: Option<f64>,
    /// Viscosity η of the fluid in the pores.
    #[parameter(default: 1e-3, unit: "Pa s", above: 0.0, source: "water of 20 °C")]
    pub viscosity: f64,
    /// Stiffness E of the skeleton under one-dimensional compression; 10 ρ₀c² of the soil if left out, ten times that
    /// of its equation of state.
    #[parameter(unit: "Pa", above: 0.0)]
    pub modulus: Option<f64>,
    /// Load on the surface of the soil, through which the fluid passes.
    #[parameter(default, unit: "Pa", min: 0.0)]
    pub load: f64,
    /// True if the grains bear the load at the start; the fluid does if not.
    #[parameter(default: false)]
    pub consolidated: bool,
    /// A wall that feeds the pores: a table with `wall`, `excess` and `rise`.
    #[parameter(default)]
    pub supply: Option<Supply>,
    /// Density of the fluid that goes in and out; that of `water`, or 1000 kg/m³, if left out.
    #[parameter(unit: "kg/m³", min: 0.0)]
    pub fluid_density: Option<f64>,
    /// True if particles grow and shrink with their packing.
    #[parameter(default: true)]
    pub swelling: bool,
    /// Relative residual at which the iteration ends.
    #[parameter(default: 1e-8, unit: "1", above: 0.0, max: 0.1, source: "ours")]
    pub tolerance: f64,
    /// Iterations after which it gives up; the step is then tried again with half its length.
    #[parameter(default: 2000, unit: "1", min: 1, source: "ours")]
    pub iterations: usize,
}

impl Darcy {
    /// k, m², at a packing.
    pub(crate) fn permeability(&self, packing: f64) -> f64 {
        let diameter = self.grain_diameter.unwrap_or(0.0);
        self.permeability
            .unwrap_or_else(|| PoreResistance::permeability(1.0 - packing, diameter))
    }
}

impl PoreModel for Darcy {
    fn settings(&self) -> PoreSettings {
        PoreSettings {
            soil: self.soil.clone(),
            water: self.water.clone(),
            porosity: self.porosity,
            bodies: self.bodies.clone(),
            fluid_density: self.fluid_density,
            swelling: self.swelling,
            darcy: Some(self.clone()),
        }
    }
}

/// φ̇ = −φ γ̇ tan ψ: dry soils, or soils so coarse that no excess pressure builds up.
///
/// Source: Roux and Radjai 1998.
///
/// ```toml
/// [pore-pressure.drained]
/// soil = "sand"
/// porosity = 0.42
/// ```
#[plugin(PorePressureEntry, "drained", "packing as a state, pores without excess pressure",
    source: "Roux and Radjai 1998", cfg(not(test)))]
pub struct Drained {
    /// Name of the phase with the pores.
    pub soil: String,
    /// Porosity n = 1 − φ of the soil at the start.
    #[parameter(unit: "1", above: 0.0, below: 1.0)]
    pub porosity: f64,
    /// Porosities of single bodies at the start, by the names of the bodies.
    #[parameter(default, unit: "1", above: 0.0, below: 1.0)]
    pub bodies: BTreeMap<String, f64>,
    /// Density of the fluid that goes in and out; 0 for dry pores.
    #[parameter(default, unit: "kg/m³", min: 0.0)]
    pub fluid_density: f64,
    /// True if particles grow and shrink with their packing.
    #[parameter(default: true)]
    pub swelling: bool,
}

impl PoreModel for Drained {
    fn settings(&self) -> PoreSettings {
        PoreSettings {
            soil: self.soil.clone(),
            water: None,
            porosity: self.porosity,
            bodies: self.bodies.clone(),
            fluid_density: Some(self.fluid_density),
            swelling: self.swelling,
            darcy: None,
        }
    }
}
