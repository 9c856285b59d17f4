//! A flow of which this process has a part, and the lists of all its particles.

use std::sync::Arc;

use sph_core::{Role, Slots, StepError, StepLimit, fields};
use sph_neighbours::World;
use sph_neighbours::decomposition::{PartError, Parts, Transport};

use crate::step::flow::Flow;
use crate::step::guard;

impl<const D: usize> Flow<D> {
    /// Leaves this rank its part; every rank holds the places and columns of the whole before.
    ///
    /// # Errors
    /// More ranks than particles.
    pub fn divide(&mut self, transport: Arc<dyn Transport>) -> Result<(), PartError> {
        let rings = self.rings();
        let parts = Parts::divide(&mut self.world, rings, transport)?;
        self.parts = Some(parts);
        Ok(())
    }

    /// Number of times that a stage goes from particles to their neighbours.
    pub fn rings(&self) -> usize {
        let hooks = self.hooks.all.iter().map(|hook| &hook.access);
        let all = self.columns.stages.iter().chain(hooks);
        let all = all.chain(&self.columns.gates).map(|access| access.rings);
        all.fold(1, usize::max)
    }

    /// The reason why the flow cannot be divided between ranks, if it cannot.
    pub fn indivisible(&self) -> Option<String> {
        let mut all = self.stages.iter().filter_map(|work| work.stage());
        let (name, why) = all.find_map(|stage| Some((stage.name(), stage.needs_all()?)))?;
        Some(format!("`{name}` cannot run on several ranks: {why}"))
    }

    /// Checks where particles are and refreshes the lists, with all ranks where there are several.
    pub(crate) fn refresh_lists(&mut self) -> Result<(), StepError> {
        let Some(parts) = &mut self.parts else {
            guard::positions(&self.world)?;
            self.world.refresh_lists()?;
            return Ok(());
        };
        let bad = guard::positions(&self.world).err();
        let expired = self.world.lists_expired()?;
        let expired = match (parts.link.any(bad.is_some(), expired), bad) {
            (Err(PartError::Elsewhere), Some(bad)) => return Err(bad),
            (any, _) => any?,
        };
        self.world.forget_pruned();
        match expired {
            true => Ok(parts.rebuild(&mut self.world, costs::<D>)?),
            false => Ok(()),
        }
    }

    pub(crate) fn rebuild_lists(&mut self) -> Result<(), StepError> {
        match &mut self.parts {
            None => Ok(self.world.rebuild_lists()?),
            Some(parts) => Ok(parts.rebuild(&mut self.world, costs::<D>)?),
        }
    }

    /// Limits become the smallest of all ranks.
    pub fn least_limits(&mut self, limits: &mut [StepLimit]) -> Result<(), StepError> {
        if let Some(parts) = &mut self.parts {
            let mut times: Vec<f64> = limits.iter().map(|l| l.dt).collect();
            parts.link.least(&mut times)?;
            limits.iter_mut().zip(times).for_each(|(l, dt)| l.dt = dt);
        }
        Ok(())
    }

    /// Gives ghosts all columns of their owners.
    pub fn tell_all(&mut self) -> Result<(), StepError> {
        match &mut self.parts {
            None => Ok(()),
            Some(parts) => Ok(parts.link.update_ghosts(&mut self.world.free, |_| true)?),
        }
    }

    /// True if any rank has a reason; every rank must call it.
    pub fn any_rank(&mut self, own: bool) -> Result<bool, StepError> {
        match &mut self.parts {
            None => Ok(own),
            Some(parts) => Ok(parts.link.any(false, own)?),
        }
    }

    /// Refreshes the lists. Where that sorts the particles, their derived columns are sorted, too: pressures and volumes of
    /// the last evaluation remain those of the same particles.
    pub(crate) fn refresh_lists_and_derived(&mut self) -> Result<(), StepError> {
        if self.parts.is_some() {
            // Derived columns go with the particles.
            return self.refresh_lists();
        }
        guard::positions(&self.world)?;
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
        self.world.free.permute(Role::Derived, &order);
        Ok(())
    }
}

/// Cost of a contact with a wall in terms of that of a candidate, in the plane and in space. A candidate takes 4 ns. In the
/// plane a contact takes 50 ns; in space it is a whole face and takes 300 ns (`dam-break-spheric2` at 4 cm).
const CONTACT: [f64; 2] = [12.0, 80.0];

/// Candidates of each particle, and its contacts with walls.
pub fn costs<const D: usize>(world: &World<D>) -> Vec<f64> {
    let contacts = &world.walls.contacts;
    let particles = world.free.len();
    if world.lists.reference.len() != particles {
        // No lists of these particles yet.
        return vec![1.0; particles];
    }
    let cost = |i: usize| {
        let candidates = world.lists.free.candidates(i).len();
        candidates as f64 + CONTACT[D - 2] * contacts.of_particle(i).len() as f64
    };
    (0..world.free.len()).map(cost).collect()
}
