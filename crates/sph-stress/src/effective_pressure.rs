//! What gives the pressure between the grains.

use sph_core::{Stage, contract};
use sph_neighbours::World;

/// Reference densities of the soils among the phases, kg/m³, in the order of the phase numbers; `None` for
/// a phase whose law feels no pressure.
pub type Soils = Vec<Option<f64>>;

/// The pressure that makes friction in soils.
pub trait EffectivePressure<const D: usize>: Send {
    /// The stage that writes [`EFFECTIVE_PRESSURE`](sph_core::fields::EFFECTIVE_PRESSURE).
    fn stage(&self, soils: Soils) -> Box<dyn Stage<World<D>>>;
    /// Whether the pores of soils are full of a fluid that bears a part of their weight.
    fn saturated(&self) -> bool {
        false
    }
}

contract!(
    /// An effective pressure that a scene may name.
    pub EffectivePressureEntry, "effective-pressure", "the pressure between the grains of a soil", EffectivePressure<D>
);
