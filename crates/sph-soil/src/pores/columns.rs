//! The columns of the pores of a soil, and its particles.

use sph_core::{Field, Index, StepError, fields};
use sph_neighbours::World;

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

/// The phase of a number; all particles where a scene has one phase.
#[derive(Clone, Copy, Debug)]
pub(crate) struct PhaseMask(pub Option<u32>);

impl PhaseMask {
    /// The column that [`test`](Self::test) reads, if any.
    pub fn column(self) -> Option<Field<Index>> {
        self.0.map(|_| fields::PHASE)
    }

    /// The test whether a particle is in it.
    pub fn test<const D: usize>(
        self,
        world: &World<D>,
    ) -> Result<impl Fn(usize) -> bool + Copy + Sync, StepError> {
        let phase = world.free.all(self.column())?.zip(self.0);
        Ok(move |i: usize| phase.is_none_or(|(phase, number)| phase[i] == number))
    }
}
