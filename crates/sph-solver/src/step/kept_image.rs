//! The kept state of particles that may go to another rank within a step.

use sph_core::{StepError, Store};
use sph_decomposition::Parts;
use sph_neighbours::World;

use crate::step::flow::Flow;

/// All particles of a rank as they were when the state was kept; nothing where one process has all.
#[derive(Default)]
pub struct KeptImage<const D: usize> {
    free: Option<Store<D>>,
    /// Lists built until then.
    builds: u64,
}

impl<const D: usize> KeptImage<D> {
    /// Copies the particles of a rank.
    pub(crate) fn keep(&mut self, parts: Option<&Parts<D>>, world: &World<D>) {
        if parts.is_some() {
            self.free = Some(world.free.copied());
            self.builds = world.lists.builds;
        }
    }
}

impl<const D: usize> Flow<D> {
    /// Brings what is kept to the particles that this rank has now, if some have gone and come since.
    pub(crate) fn kept_follows(&mut self) -> Result<(), StepError> {
        let (Some(parts), Some(image)) = (&self.parts, &mut self.kept_image.free) else {
            return Ok(());
        };
        // All ranks build their lists together.
        let builds = self.world.lists.builds;
        if builds == self.kept_image.builds {
            return Ok(());
        }
        parts.follow(image, &self.world.free)?;
        self.kept.follow(image)?;
        self.kept_rates.keep(image, &self.evolved)?;
        self.kept_image.builds = builds;
        Ok(())
    }
}
