//! Times of the parts of a run.

use std::time::Duration;

/// Wall-clock time of one kind of work.
#[derive(Clone, Debug)]
pub struct Timing {
    /// Stage or service.
    pub name: String,
    /// Time spent so far.
    pub spent: Duration,
}

pub(crate) const LISTS: usize = 0;
/// Name of the time spent on neighbour lists.
pub const LISTS_NAME: &str = "neighbour lists";
/// Place of kicks and drifts among the timings; the stages follow, and then the work within a step.
pub(crate) const MOTION: usize = 1;
pub(crate) const MOTION_NAME: &str = "kick and drift";
