//! Where the time of a run goes.

use std::time::Duration;

use crate::step::flow::Flow;

/// Wall-clock time of one kind of work.
#[derive(Clone, Debug)]
pub struct Timing {
    /// Stage or service.
    pub name: String,
    /// Time spent so far.
    pub spent: Duration,
}

/// Place of the list refresh among the timings.
pub(crate) const LISTS: usize = 0;
/// Name of the time spent on neighbour lists.
pub(crate) const LISTS_NAME: &str = "neighbour lists";
/// Place of kicks and drifts among the timings; the stages follow, and then the work within a step.
pub(crate) const MOTION: usize = 1;

impl<const D: usize> Flow<D> {
    pub(crate) fn reset_timings(&mut self) {
        let services = [LISTS_NAME, "kick and drift"].map(String::from);
        let names = services
            .into_iter()
            .chain(self.stages.iter().map(|s| s.name()))
            .chain(self.works.iter().map(|w| w.name()));
        self.timings = names
            .map(|name| Timing {
                name,
                spent: Duration::ZERO,
            })
            .collect();
    }

    /// Time spent per stage and service since the assembly.
    pub fn timings(&self) -> &[Timing] {
        &self.timings
    }
}
