//! Work on blocks side by side, and on runs of particles of one phase. Tasks are made here from closures behind a
//! reference, so that each is compiled once per type of item and not once per closure.

use std::ops::Range;

use rayon::prelude::*;

/// Gives `work` every block of `size` items (the last may have fewer) with its number.
pub fn each_block<T: Send>(all: &mut [T], size: usize, work: &(dyn Fn(usize, &mut [T]) + Sync)) {
    let blocks = all.par_chunks_mut(size).enumerate();
    blocks.for_each(|(number, block)| work(number, block));
}

/// Joins the results of `of` for the indices below `count`, a range of at most `size` at a time; `join` must not depend
/// on the order.
pub fn joined<A: Copy + Send + Sync>(
    count: usize,
    size: usize,
    zero: A,
    of: &(dyn Fn(Range<usize>) -> A + Sync),
    join: fn(A, A) -> A,
) -> A {
    let ranges = (0..count.div_ceil(size)).into_par_iter();
    let each = ranges.map(|k| of(k * size..count.min((k + 1) * size)));
    each.reduce(|| zero, join)
}

/// Particles per batch, which stays in the cache.
const BATCH: usize = 1024;

/// Gives every run of one phase within a batch to `work`: the number of the phase, which particles
/// they are, and their part of the column.
///
/// Without a phase column all particles are of phase 0.
pub fn by_phase<T: Send>(
    phase: Option<&[u32]>,
    column: &mut [T],
    work: impl Fn(usize, Range<usize>, &mut [T]) + Sync,
) {
    each_block(column, BATCH, &|k, part| {
        let from = k * BATCH;
        for (number, run) in runs(phase, from, part.len()) {
            let own = run.start - from..run.end - from;
            work(number, run, &mut part[own]);
        }
    });
}

/// The runs of one phase within a batch that starts at `from`, with the number of their phase;
/// one run where there is no phase column.
fn runs(
    phase: Option<&[u32]>,
    from: usize,
    len: usize,
) -> impl Iterator<Item = (usize, Range<usize>)> {
    let mut next = from;
    std::iter::from_fn(move || {
        let (start, end) = (next, from + len);
        if start >= end {
            return None;
        }
        let (law, stop) = match phase {
            None => (0, end),
            Some(phase) => {
                let own = phase[start];
                let other = phase[start..end].iter().position(|p| *p != own);
                (own as usize, other.map_or(end, |k| start + k))
            }
        };
        next = stop;
        Some((law, start..stop))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn runs_cover_a_batch_phase_by_phase() {
        let phase = [0, 0, 1, 1, 1, 0];
        let all: Vec<_> = runs(Some(&phase), 1, 5).collect();
        assert_eq!(all, [(0, 1..2), (1, 2..5), (0, 5..6)]);
        assert_eq!(runs(None, 3, 4).collect::<Vec<_>>(), [(0, 3..7)]);
        assert_eq!(runs(Some(&phase), 6, 0).count(), 0);
    }
}
