//! What happens after a step that failed.

use sph_core::StepError;

use crate::checkpoint;
use crate::driver::Observer;
use crate::error::{Failure, SolverError};
use crate::output::write_everything;
use crate::report::advice;
use crate::run::Running;
use crate::snapshot::Snapshot;
use crate::summary::Status;
use crate::trouble::Trouble;

impl<const D: usize> Running<'_, D> {
    /// After a step that failed: back to the state before it, with half of the step.
    ///
    /// # Errors
    /// If there is no such state, or there were too many tries.
    pub(crate) fn go_back(
        &mut self,
        cause: StepError,
        snapshot: Option<&Snapshot<D>>,
        observer: &mut (dyn Observer + Send),
    ) -> Result<(), SolverError> {
        self.note_trouble(&cause);
        let Some(kept) = snapshot.filter(|_| self.counters.retries < self.scene.run.retries) else {
            return Err(self.fail(cause, snapshot, observer));
        };
        self.counters.retries += 1;
        self.counters.rolled_back += 1;
        kept.restore(&mut self.parts.flow)?;
        let scale = 0.5 * f64::from_bits(self.counters.step_scale);
        self.counters.step_scale = scale.to_bits();
        observer.message(&format!(
            "step {} failed ({cause}); going back to t = {:.6} s with {scale:.4} of the step",
            self.counters.steps, self.parts.flow.world.time
        ));
        Ok(())
    }

    /// Keeps the first sign of trouble.
    fn note_trouble(&mut self, cause: &StepError) {
        let (time, step) = (self.parts.flow.world.time, self.counters.steps);
        let first = &mut self.counters.first_trouble;
        first.get_or_insert_with(|| Trouble::of(cause, time, step));
    }

    /// Writes what a person needs to see why the run failed.
    pub(crate) fn fail(
        &mut self,
        cause: StepError,
        snapshot: Option<&Snapshot<D>>,
        observer: &mut (dyn Observer + Send),
    ) -> SolverError {
        self.note_trouble(&cause);
        let (time, step) = (self.parts.flow.world.time, self.counters.steps);
        let bad = self.options.out.join("bad_state.vtu");
        let bad_state = write_everything(&self.parts.flow, &bad)
            .is_ok()
            .then_some(bad);
        let mut checkpoint = None;
        if let Some(snapshot) = snapshot {
            let back = snapshot
                .restore(&mut self.parts.flow)
                .map_err(SolverError::from);
            let saved = back
                .and_then(|()| Ok(self.evaluate()?))
                .and_then(|()| self.save());
            if saved.is_ok() {
                checkpoint = Some(self.options.out.join(checkpoint::FILE));
            }
        }
        let mut failure = Failure {
            first: self.counters.first_trouble.clone().unwrap_or_default(),
            summary: None,
            time,
            step,
            advice: advice(&cause),
            cause,
            checkpoint,
            bad_state,
        };
        match self.write_summary(Status::Failed, Some(&failure)) {
            Ok(summary) => failure.summary = Some(Box::new(summary)),
            Err(error) => {
                observer.message(&format!("the summary could not be written: {error}"));
            }
        }
        SolverError::Failed(Box::new(failure))
    }
}
