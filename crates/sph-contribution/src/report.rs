//! Counts and remarks of a piece of physics, for summaries.

use serde_json::Value as Json;
use sph_core::StepError;

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
