//! Particles are sorted when lists expire: a step that goes on with values derived before sorts them, too.

use sph_core::{Slots, StepError, fields};

use crate::step::flow::Flow;

impl<const D: usize> Flow<D> {
    /// Refreshes the lists. Where that sorts the particles, their derived columns are sorted, too: pressures and volumes of
    /// the last evaluation remain those of the same particles.
    pub(crate) fn refresh_lists_and_derived(&mut self) -> Result<(), StepError> {
        if self.parts.is_some() {
            // Derived columns go with the particles.
            return self.refresh_lists();
        }
        crate::step::guard::positions(&self.world)?;
        if !self.world.lists_expired()? {
            self.world.refresh_lists()?;
            return Ok(());
        }
        let earlier = self.world.free.get(fields::IDENTITY)?.to_vec();
        self.world.refresh_lists()?;
        let now = self.world.free.get(fields::IDENTITY)?;
        if *now == earlier {
            return Ok(());
        }
        let slots = Slots::from_identities(&earlier);
        let order: Vec<u32> = now.iter().filter_map(|&id| slots.slot(id)).collect();
        self.world.free.permute_derived(&order);
        Ok(())
    }
}
