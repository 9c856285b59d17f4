//! The particles of the phase with the pores.

use sph_core::{Access, StepError, fields};
use sph_neighbours::World;

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
