//! Strain rates that are kept for the next step.

use sph_contribution::{StepHook, StepMoment, StepPhase};
use sph_core::{Access, StepError, fields};

use crate::columns::LAST_STRAIN;

/// Keeps the strain rate of a step, which came along with its interactions, for the closure in the next one.
pub(crate) struct StrainRecorder;

impl<const D: usize> StepHook<D> for StrainRecorder {
    fn name(&self) -> String {
        "strain rate of the step".into()
    }
    fn access(&self) -> Access {
        Access::none().here(fields::STRAIN_RATE).writes(LAST_STRAIN)
    }
    fn phases(&self) -> &'static [StepPhase] {
        &[StepPhase::AfterKick]
    }
    fn run(&mut self, _: StepPhase, moment: &mut StepMoment<'_, D>) -> Result<(), StepError> {
        let world = &mut *moment.world;
        let mut kept = world.free.take(LAST_STRAIN)?;
        kept.copy_from_slice(world.free.get(fields::STRAIN_RATE)?);
        Ok(world.free.put(LAST_STRAIN, kept)?)
    }
}
