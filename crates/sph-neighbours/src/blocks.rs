//! Work on blocks side by side. Tasks are made here from closures behind a reference, so that each is compiled once per
//! type of item and not once per closure.

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
