//! The kept state of particles that may go to another rank within a step.

use sph_core::Store;
use sph_neighbours::World;
use sph_neighbours::decomposition::{PartError, Parts};

/// All particles of a rank as they were when the state was kept; nothing where one process has all.
#[derive(Default)]
pub struct SavedParticles<const D: usize> {
    free: Option<Store<D>>,
    /// Lists built until then.
    builds: u64,
}

impl<const D: usize> SavedParticles<D> {
    /// Copies the particles of a rank.
    pub(crate) fn keep(&mut self, parts: Option<&Parts<D>>, world: &World<D>) {
        if parts.is_some() {
            self.free = Some(world.free.copied());
            self.builds = world.lists.builds;
        }
    }

    /// The copies in the order of the particles that this rank has now, if some have gone and come since.
    pub(crate) fn follow(
        &mut self,
        parts: Option<&Parts<D>>,
        world: &World<D>,
    ) -> Result<Option<&Store<D>>, PartError> {
        let (Some(parts), Some(free)) = (parts, &mut self.free) else {
            return Ok(None);
        };
        // All ranks build their lists together.
        let builds = world.lists.builds;
        if builds == self.builds {
            return Ok(None);
        }
        parts.follow(free, &world.free)?;
        self.builds = builds;
        Ok(Some(free))
    }
}
