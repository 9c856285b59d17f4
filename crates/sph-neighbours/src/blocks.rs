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
    each_block(column, BATCH, &|k, mut part| {
        let mut from = k * BATCH;
        let Some(phase) = phase else {
            return work(0, from..from + part.len(), part);
        };
        for run in phase[from..from + part.len()].chunk_by(|a, b| a == b) {
            let own = part.split_off_mut(..run.len()).unwrap_or_default();
            work(run[0] as usize, from..from + run.len(), own);
            from += run.len();
        }
    });
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn runs_cover_a_column_phase_by_phase() {
        let mut phase = vec![0; 2 * BATCH];
        phase[BATCH - 1..BATCH + 2].fill(1);
        let mut column: Vec<usize> = (0..phase.len()).collect();
        by_phase(Some(&phase), &mut column, |law, run, part| {
            assert!(run.clone().eq(part.iter().copied()));
            part.fill(law);
        });
        assert!(
            column
                .iter()
                .zip(&phase)
                .all(|(law, phase)| *law == *phase as usize)
        );
        by_phase(None, &mut column, |law, run, _| {
            assert!(law == 0 && run.len() == BATCH)
        });
    }
}
