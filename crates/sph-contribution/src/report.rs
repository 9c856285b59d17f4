//! Counts and remarks of a piece of physics, for summaries.

use serde_json::Value as Json;
use sph_core::{Access, StepError};
use sph_neighbours::World;

use crate::{StepHook, StepPhase};

/// Counts of a hook since the start, and its remarks at the end of a run.
#[derive(Debug, Default)]
pub struct Report {
    /// Counts, for checkpoints.
    pub counts: Option<Json>,
    /// Key of the counts in the summary; `None` leaves them out.
    pub summary: Option<&'static str>,
    /// The error that leaves the run without a result.
    pub verdict: Option<StepError>,
    /// Reasons to doubt the results.
    pub warnings: Vec<String>,
    /// Changes that a person may try next time.
    pub advice: Vec<String>,
    /// Most bytes that the hook has held beside columns.
    pub most_bytes: usize,
}

impl Report {
    /// A reason to doubt the results, and nothing else.
    pub fn warning(text: impl Into<String>) -> Self {
        Report {
            warnings: vec![text.into()],
            ..Report::default()
        }
    }

    /// A change that a person may try next time, and nothing else.
    pub fn advice(text: impl Into<String>) -> Self {
        Report {
            advice: vec![text.into()],
            ..Report::default()
        }
    }
}

/// A hook that works in no phase.
pub(crate) struct Reporting<F> {
    pub name: String,
    pub access: Access,
    pub report: F,
}

impl<const D: usize, F: Fn(&World<D>) -> Report + Send> StepHook<D> for Reporting<F> {
    fn name(&self) -> String {
        self.name.clone()
    }
    fn access(&self) -> Access {
        self.access.clone()
    }
    fn phases(&self) -> &'static [StepPhase] {
        &[]
    }
    fn report(&self, world: &World<D>) -> Report {
        (self.report)(world)
    }
}
