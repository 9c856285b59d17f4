//! Cells of grids.

/// All tuples of whole numbers in some ranges, ascending, the last number fastest.
pub(crate) fn product<const D: usize>(ranges: [[i64; 2]; D]) -> impl Iterator<Item = [i64; D]> {
    let lengths = ranges.map(|[first, last]| (last - first + 1).max(0));
    (0..lengths.iter().product()).map(move |mut n| {
        let mut at = ranges.map(|[first, _]| first);
        for k in (0..D).rev() {
            at[k] += n % lengths[k];
            n /= lengths[k];
        }
        at
    })
}

/// Numbers listed by the cells that they are in, ascending: where the list of each cell starts, and the end of the last one;
/// all lists one behind the other.
pub(crate) fn listed<I: Iterator<Item = usize>>(
    numbers: usize,
    cells: usize,
    cells_of: impl Fn(usize) -> I,
) -> (Vec<u32>, Vec<u32>) {
    let mut starts = vec![0; cells + 1];
    for cell in (0..numbers).flat_map(&cells_of) {
        starts[cell + 1] += 1;
    }
    for cell in 0..cells {
        starts[cell + 1] += starts[cell];
    }
    let mut lists = vec![0; starts[cells] as usize];
    let mut next = starts.clone();
    for number in 0..numbers {
        for cell in cells_of(number) {
            lists[next[cell] as usize] = number as u32;
            next[cell] += 1;
        }
    }
    (starts, lists)
}
