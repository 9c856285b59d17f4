//! The kind of the pressure between the grains.

use sph_contribution::{Contribution, contribution_kind};
use sph_core::Work;

/// Reference densities of the soils among the phases, kg/m³, in the order of the phase numbers; `None` for
/// a phase whose law reads no pressure.
pub type Soils = Vec<Option<f64>>;

contribution_kind!(
    /// An effective pressure that a scene may name: the pressure that makes friction in soils. One of its stages writes
    /// [`EFFECTIVE_PRESSURE`](sph_core::fields::EFFECTIVE_PRESSURE).
    pub EffectivePressureEntry, "effective-pressure", One, "the pressure between the grains of a soil",
    .absent("that of the equation of state if left out").ordered(20).works(Work::Others)
);
