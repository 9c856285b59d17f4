//! Decisions that all ranks take together.

use sph_core::StepError;

use crate::decomposition::{PartError, Parts};

impl<const D: usize> Parts<D> {
    /// True if a rank answers yes; an error if one has failed. Every message between ranks is preceded by this, so that
    /// a rank that fails anywhere in a step reaches the others, which wait here.
    ///
    /// # Errors
    /// If a rank has failed, on all ranks alike; messages that fail.
    pub fn any(&mut self, failed: bool, yes: bool) -> Result<bool, PartError> {
        self.link.any(failed, yes)
    }

    /// Goes on if no rank has failed.
    ///
    /// # Errors
    /// As [`any`](Self::any).
    pub fn all_well(&mut self) -> Result<(), PartError> {
        self.any(false, false).map(|_| ())
    }

    /// Goes on if no rank has failed in the work before, of which some may have informed the others already.
    ///
    /// # Errors
    /// As [`any`](Self::any).
    pub fn confirm(&mut self, failed: bool) -> Result<(), PartError> {
        self.link.confirm(failed)
    }

    /// After a failure on any rank, on all ranks: informs the others, and gives the cause that the first rank
    /// has that has one.
    pub fn share_failure(&mut self, cause: StepError) -> StepError {
        self.link.share_failure(cause)
    }

    /// The least of every value over all ranks.
    ///
    /// # Errors
    /// As [`any`](Self::any).
    pub fn least(&mut self, values: &mut [f64]) -> Result<(), PartError> {
        values.iter_mut().for_each(|v| *v = -*v);
        self.link.agree(false, values)?;
        values.iter_mut().for_each(|v| *v = -*v);
        Ok(())
    }
}
