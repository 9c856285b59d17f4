//! A flow as the system that a time integrator advances.
//!
//! The motions are compiled here for the plane and for space: a crate that steps a flow does not compile them again.

use std::any::Any;

use sph_core::{AnyField, Recall, StepError, StepLimit, System, fields};

use crate::step::flow::Flow;
use crate::step::hooks::{Boundary, writes_any};

enum Motion {
    Evaluate,
    EvaluateForces,
    Keep,
    Recall(Recall),
    AverageRates,
    Kick(f64),
    Drift(f64),
}

fn perform<const D: usize>(flow: &mut Flow<D>, motion: Motion) -> Result<(), StepError> {
    let flow: &mut dyn Any = flow;
    if let Some(flow) = flow.downcast_mut() {
        return plane(flow, motion);
    }
    match flow.downcast_mut() {
        Some(flow) => space(flow, motion),
        None => unreachable!("flows have two or three dimensions"),
    }
}

fn plane(flow: &mut Flow<2>, motion: Motion) -> Result<(), StepError> {
    flow.perform(motion)
}

fn space(flow: &mut Flow<3>, motion: Motion) -> Result<(), StepError> {
    flow.perform(motion)
}

/// Methods that each perform a motion.
macro_rules! motions {
    ($($method:ident($($value:ident: $type:ty)?) => $motion:expr;)+) => {$(
        fn $method(&mut self $(, $value: $type)?) -> Result<(), StepError> {
            perform(self, $motion)
        }
    )+};
}

impl<const D: usize> System for Flow<D> {
    motions! {
        evaluate() => Motion::Evaluate;
        evaluate_forces() => Motion::EvaluateForces;
        keep() => Motion::Keep;
        recall(what: Recall) => Motion::Recall(what);
        average_rates() => Motion::AverageRates;
        kick(dt: f64) => Motion::Kick(dt);
        drift(dt: f64) => Motion::Drift(dt);
    }

    fn time(&self) -> f64 {
        self.world.time
    }

    fn limits(&self) -> Vec<StepLimit> {
        self.step_limits().unwrap_or_default()
    }
}

/// Columns of an evaluation that come first where its densities are changed.
const DENSITIES: [AnyField; 3] = [
    fields::RENORMALISATION.any(),
    fields::DENSITY.any(),
    fields::VOLUME.any(),
];

impl<const D: usize> Flow<D> {
    /// An evaluation with a change behind the densities, before all that depends on them. The change is told whether the
    /// state is one to which a run came back, of which it was a part.
    ///
    /// # Errors
    /// Those of stages, as below, and of the change.
    pub fn evaluate_with(
        &mut self,
        change: impl FnOnce(&mut Self, bool) -> Result<(), StepError>,
    ) -> Result<(), StepError> {
        let restored = self.begin_evaluation()?;
        self.run_wanted(restored, |stage| writes_any(stage, &DENSITIES))?;
        change(self, restored)?;
        self.run_wanted(restored, |stage| !writes_any(stage, &DENSITIES))?;
        self.observe(Boundary::Evaluated, 0.0)
    }

    /// Computes densities again, whose constants a change of [`evaluate_with`](Self::evaluate_with) has moved.
    pub fn sum_densities(&mut self) -> Result<(), StepError> {
        self.run_wanted(false, |stage| writes_any(stage, &DENSITIES[1..]))
    }

    fn perform(&mut self, motion: Motion) -> Result<(), StepError> {
        match motion {
            Motion::Evaluate => {
                self.run_stages(|_| true)?;
                self.observe(Boundary::Evaluated, 0.0)
            }
            Motion::EvaluateForces => {
                let state = [fields::DENSITY, fields::VOLUME, fields::PRESSURE].map(|f| f.any());
                self.refresh_lists_and_derived()?;
                self.run_stages(|stage| !writes_any(stage, &state))
            }
            Motion::Keep => Ok(self.keep_within_step()?),
            Motion::Recall(what) => self.recall_kept(what),
            Motion::AverageRates => self.average_with_kept(),
            Motion::Kick(dt) => self.kick_over(dt),
            Motion::Drift(dt) => self.drift_over(dt),
        }
    }
}
