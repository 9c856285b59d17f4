//! The kind of models of the pores of a soil, and their columns.

use std::collections::BTreeMap;

use sph_core::{Access, StepError, Work, contract, fields, parameters};
use sph_neighbours::World;

use crate::seepage::PoreResistance;

sph_core::fields! {
    /// Volume φ of the grains per volume of a soil; 0 outside of soils.
    pub PACKING: Scalar = "packing", "1", "volume of the grains per volume of the soil";
    /// Volume G of the grains of a particle, which stays.
    pub GRAIN_VOLUME: Scalar = "grain_volume", "m^d", "volume of the grains of a particle of soil";
    /// Pressure of the fluid in the pores less that of the same fluid at rest; 0 outside of soils.
    pub EXCESS_PORE_PRESSURE: Scalar = "excess_pore_pressure", "Pa",
        "pressure of the fluid in the pores of a soil less that at rest";
    /// Effective pressure of the soil if the fluid in its pores were at rest.
    pub DRAINED_PRESSURE: Scalar = "drained_pressure", "Pa",
        "effective pressure of a soil with the fluid in its pores at rest";
    /// The drained pressure at the last solve; negative before the first.
    pub EARLIER_DRAINED_PRESSURE: Scalar = "earlier_drained_pressure", "Pa",
        "drained pressure at the last solve for the pore pressure";
    /// Pressure of the grains with the friction that dilation adds: p' (1 + tan ψ/μ).
    pub FRICTION_PRESSURE: Scalar = "friction_pressure", "Pa",
        "effective pressure, enlarged by the friction of dilation";
}

/// Permeability k of a packing, m².
#[derive(Clone, Copy, Debug)]
pub enum Permeability {
    /// The same at all packings.
    Given(f64),
    /// Of grains of a diameter, m, by Kozeny and Carman.
    Grains(f64),
}

impl Permeability {
    /// k, m², at a packing.
    pub fn at(self, packing: f64) -> f64 {
        match self {
            Permeability::Given(k) => k,
            Permeability::Grains(d) => PoreResistance::permeability(1.0 - packing, d),
        }
    }
}

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

/// The fluid that drains, and the skeleton that it drains from.
#[derive(Clone, Debug)]
pub struct Skeleton {
    /// k.
    pub permeability: Permeability,
    /// η, Pa s.
    pub viscosity: f64,
    /// Stiffness of the contacts, Pa; 10 ρ₀c² of the soil if `None`.
    pub modulus: Option<f64>,
    /// Load that the surface bears, Pa.
    pub load: f64,
    /// True if the grains bear it at the start.
    pub consolidated: bool,
    /// A wall that feeds the pores.
    pub supply: Option<Supply>,
    /// Relative residual at which the iteration for the excess pressure ends.
    pub tolerance: f64,
    /// Iterations after which it gives up.
    pub iterations: usize,
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
    /// The excess pressure; `None` if the fluid passes freely.
    pub skeleton: Option<Skeleton>,
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

/// The phase with the pores; `None` where a scene has one phase.
#[derive(Clone, Copy, Debug)]
pub(crate) struct SoilPhase(pub Option<u32>);

impl SoilPhase {
    /// The columns that [`mask`](Self::mask) reads.
    pub fn access(self) -> Access {
        match self.0 {
            None => Access::none(),
            Some(_) => Access::none().both(fields::PHASE),
        }
    }

    /// Its particles.
    pub fn mask<const D: usize>(self, world: &World<D>) -> Result<SoilMask<'_>, StepError> {
        Ok(SoilMask(match self.0 {
            None => None,
            Some(number) => Some((world.free.get(fields::PHASE)?, number)),
        }))
    }
}

/// The particles of the phase with the pores.
#[derive(Clone, Copy)]
pub(crate) struct SoilMask<'a>(Option<(&'a [u32], u32)>);

impl SoilMask<'_> {
    /// True for a particle of the soil.
    pub fn has(self, i: usize) -> bool {
        self.0.is_none_or(|(phase, number)| phase[i] == number)
    }
}
