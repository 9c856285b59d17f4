//! Numbers that differ between phases.

use sph_core::{Access, StepError, fields};
use sph_neighbours::World;

use sph_rheology::state::{BoundState, Laws};

/// One number per phase; the phase column is read only where there are several.
#[derive(Clone, Debug)]
pub(crate) struct PerPhase(Vec<f64>);

impl PerPhase {
    /// A number of every law.
    pub fn new(laws: &Laws, number: impl Fn(&dyn BoundState) -> f64) -> Self {
        PerPhase(laws.iter().map(|law| number(&**law)).collect())
    }
    /// The column read.
    pub fn access(&self) -> Access {
        match self.0.len() {
            0 | 1 => Access::none(),
            _ => Access::none().both(fields::PHASE),
        }
    }
    /// The phase column, where it counts.
    pub fn column<'a, const D: usize>(
        &self,
        world: &'a World<D>,
    ) -> Result<Option<&'a [u32]>, StepError> {
        Ok(match self.0.len() {
            0 | 1 => None,
            _ => Some(world.free.get(fields::PHASE)?),
        })
    }
    /// The number of a phase.
    #[inline(always)]
    pub fn at(&self, phase: u32) -> f64 {
        self.0[phase as usize]
    }
}
