//! Members of a cluster, and their candidates.

use std::ops::Range;

use sph_kernels::lanes::MOST;

/// Some particles that follow each other, and all that any of them may have within reach.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Members<'a> {
    pub from: usize,
    pub count: usize,
    /// Candidates, the members themselves among them, in index order.
    pub candidates: &'a [u32],
}

impl Members<'_> {
    #[inline(always)]
    pub fn range(&self) -> Range<usize> {
        self.from..self.from + self.count
    }
}

/// Members of a cluster in groups of at most as many as there are lanes.
pub(crate) fn groups(members: Members<'_>, lanes: usize) -> impl Iterator<Item = Members<'_>> {
    let step = lanes.min(MOST);
    (0..members.count).step_by(step).map(move |k| Members {
        from: members.from + k,
        count: step.min(members.count - k),
        candidates: members.candidates,
    })
}
