//! Decisions that all ranks take together.

use sph_core::StepError;

use crate::{PartError, Parts};

impl<const D: usize> Parts<D> {
    /// Whether anybody says yes, if nobody has failed. Every message between ranks is preceded by this, so that a rank that fails
    /// anywhere in a step reaches the others, who wait here.
    ///
    /// # Errors
    /// If somebody has failed, on all ranks alike; messages that fail.
    pub fn any(&mut self, failed: bool, yes: bool) -> Result<bool, PartError> {
        let mut values = [failed, yes].map(|b| f64::from(u8::from(b)));
        let sent = self.transport.largest(&mut values);
        // Who has no connection has nobody to tell.
        self.told = values[0] > 0.0 || sent.is_err();
        sent?;
        match self.told {
            true => Err(PartError::Elsewhere),
            false => Ok(values[1] > 0.0),
        }
    }

    /// Goes on if nobody has failed.
    ///
    /// # Errors
    /// As [`any`](Self::any).
    pub fn all_well(&mut self) -> Result<(), PartError> {
        self.any(false, false).map(|_| ())
    }

    /// After a failure on any rank, on all ranks: tells those that do not know of it, and gives the cause that the first rank
    /// has that knows one.
    pub fn confess(&mut self, cause: StepError) -> StepError {
        if !std::mem::take(&mut self.told) {
            // They answer with the failure itself.
            let _ = self.any(true, false);
            self.told = false;
        }
        let own = match StepError::from(PartError::Elsewhere) == cause {
            true => String::new(),
            false => cause.to_string(),
        };
        let Ok(all) = self.transport.all(own.as_bytes()) else {
            return cause;
        };
        match all.iter().position(|text| !text.is_empty()) {
            Some(rank) if rank != self.transport.rank() => StepError::Stage {
                stage: format!("rank {rank}"),
                reason: String::from_utf8_lossy(&all[rank]).into_owned(),
            },
            _ => cause,
        }
    }

    /// The least of every value over all ranks.
    ///
    /// # Errors
    /// As [`any`](Self::any).
    pub fn least(&mut self, values: &mut [f64]) -> Result<(), PartError> {
        self.all_well()?;
        values.iter_mut().for_each(|v| *v = -*v);
        self.transport.largest(values)?;
        values.iter_mut().for_each(|v| *v = -*v);
        Ok(())
    }
}
