//! Elastic forces in steps of their own, between the kick and the drift of the flow.

use std::time::Instant;

use sph_core::StepError;
use sph_stress::ElasticSubSteps;

use crate::Flow;

/// Name of the time spent on elastic sub-steps.
pub(crate) const SUB_STEPS_NAME: &str = "elastic sub-steps";

/// Sub-steps and what is left to do of the last ones.
pub struct SubSteps<const D: usize> {
    pub(crate) of: ElasticSubSteps<D>,
    /// By which the remembered stress is behind the velocity, s.
    behind: f64,
}

impl<const D: usize> SubSteps<D> {
    pub(crate) fn new(of: ElasticSubSteps<D>) -> Self {
        SubSteps { of, behind: 0.0 }
    }

    /// What bounds them, for plans.
    pub(crate) fn formula(&self) -> String {
        format!(
            "elastic sub-steps: {:.2e} s at most, as many within a step as it takes",
            self.of.longest()
        )
    }
}

impl<const D: usize> Flow<D> {
    /// Elastic forces of a step, where they have sub-steps.
    pub(crate) fn vibrate(&mut self, dt: f64) -> Result<(), StepError> {
        let (Some(sub), Some(motion)) = (&mut self.sub_steps, &mut self.elastic) else {
            return Ok(());
        };
        let start = Instant::now();
        sub.behind = sub.of.kick(&mut self.world, motion, dt)?;
        let timing = self.timings.iter_mut().find(|t| t.name == SUB_STEPS_NAME);
        if let Some(timing) = timing {
            timing.spent += start.elapsed();
        }
        Ok(())
    }

    /// How far the stress has to follow in a drift over `dt`, s.
    pub(crate) fn stress_behind(&self, dt: f64) -> f64 {
        self.sub_steps.as_ref().map_or(dt, |sub| sub.behind)
    }

    /// To the mean velocity of the sub-steps, with a share of 1, and back from it, with −1.
    pub(crate) fn shift_to_mean(&mut self, share: f64) -> Result<(), StepError> {
        match &self.sub_steps {
            Some(sub) => sub.of.shift(&mut self.world, share),
            None => Ok(()),
        }
    }
}
