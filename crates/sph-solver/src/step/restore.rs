//! The state of a flow taken and put back.

use sph_core::{FieldError, StepError};

use crate::{Flow, Snapshot};

impl<const D: usize> Snapshot<D> {
    /// Copies the state; reuses its buffers.
    pub fn take(&mut self, flow: &Flow<D>) -> Result<(), FieldError> {
        self.save(&flow.world, flow.walls.as_deref(), &flow.loads)
    }

    /// Puts the state back. If the particles were sorted meanwhile, they return to their
    /// order; those that left since come back, those that came in are gone.
    pub fn restore(&self, flow: &mut Flow<D>) -> Result<(), StepError> {
        let walls = (flow.walls.as_deref_mut(), &mut flow.loads);
        self.put_back(&mut flow.world, walls)?;
        // The results of the evaluation of this state are among it.
        flow.restored = true;
        flow.rebuild_lists()
    }
}
