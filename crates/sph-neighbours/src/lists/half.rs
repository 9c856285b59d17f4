//! Sweeps in two halves: first the particles sent to others, then the rest, while the messages are on their way.

use crate::{CHUNK, Clusters};

/// Particles for which a sweep is to sum; its sums for the others stay.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SweepHalf {
    /// Marks of particles that are sent to others, or that are in a cluster with one.
    edge: Vec<bool>,
    /// True if the other half is requested.
    inner: bool,
}

impl SweepHalf {
    /// The first half: clusters with a particle that is `sent`. The `lists` are those of the sweep.
    pub fn first(lists: &Clusters, sent: &[bool]) -> Self {
        let mut edge = vec![false; sent.len()];
        for block in 0..sent.len().div_ceil(CHUNK) {
            for members in lists.of_block(block) {
                let own = members.range();
                let some = sent[own.clone()].iter().any(|sent| *sent);
                edge[own].fill(some);
            }
        }
        SweepHalf { edge, inner: false }
    }

    /// The other half.
    pub fn second(self) -> Self {
        SweepHalf {
            inner: true,
            ..self
        }
    }
}

/// True if a particle is needed: all are outside of halves.
#[inline]
pub fn is_wanted(half: Option<&SweepHalf>, particle: usize) -> bool {
    half.is_none_or(|half| half.edge[particle] != half.inner)
}
