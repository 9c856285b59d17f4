//! Verlet lists: candidates within the support plus a skin, in cell order.

use std::ops::Range;

use rayon::prelude::*;
use sph_core::{Pool, Vect};

use crate::{CellGrid, Domain};

/// Particles that one task works through; also the granule of the lists.
pub const CHUNK: usize = 64;

#[derive(Clone, Debug, Default)]
struct Block {
    starts: Vec<u32>,
    candidates: Vec<u32>,
}

impl Block {
    /// No row yet.
    fn begin(&mut self) {
        self.starts.clear();
        self.starts.reserve_exact(CHUNK + 1);
        self.starts.push(0);
    }
}

/// Puts candidates into a buffer that is at most a quarter too large: vectors that grow by doubling would be by half,
/// in the mean, and lists are most of a run's memory.
pub(crate) fn keep_all(held: &mut Vec<u32>, candidates: &[u32]) {
    let (needed, room) = (candidates.len(), held.capacity());
    if needed > room || needed + needed / 4 < room {
        *held = Vec::with_capacity(needed + needed / 16);
    }
    held.clear();
    held.extend_from_slice(candidates);
}

/// Makes room for `room` candidates in a buffer that is used again and again.
pub(crate) fn make_room(buffer: &mut Vec<u32>, room: usize) {
    if buffer.len() < room {
        buffer.resize(room.next_power_of_two(), 0);
    }
}

/// For every target the indices of the sources that may be within reach.
#[derive(Clone, Debug, Default)]
pub struct NeighbourList {
    blocks: Vec<Block>,
    len: usize,
}

impl NeighbourList {
    /// Finds, for every target, the sources nearer than `reach`.
    ///
    /// The candidates stand in the grid's cell order, which is index order where the sources are sorted.
    pub fn build<const D: usize>(
        &mut self,
        targets: &[Vect<D>],
        sources: &[Vect<D>],
        grid: &CellGrid<D>,
        reach: f64,
        domain: &Domain<D>,
    ) {
        self.build_on(&Pool::default(), [targets, sources], grid, (reach, domain));
    }

    /// The same with the buffers of tasks before.
    pub(crate) fn build_on<const D: usize>(
        &mut self,
        pool: &Pool<(Vec<u32>, CellRanges)>,
        [targets, sources]: [&[Vect<D>]; 2],
        grid: &CellGrid<D>,
        (reach, domain): (f64, &Domain<D>),
    ) {
        self.len = targets.len();
        self.blocks
            .resize_with(targets.len().div_ceil(CHUNK), Block::default);
        let reach2 = reach * reach;
        let room = || pool.acquire();
        self.blocks
            .par_iter_mut()
            .enumerate()
            .for_each_init(room, |room, (b, block)| {
                let (buffer, around) = &mut **room;
                block.begin();
                let mut len = 0;
                let from = b * CHUNK;
                let to = (from + CHUNK).min(targets.len());
                around.cell = None;
                for x in &targets[from..to] {
                    around.go_to(x, grid, reach);
                    let room = len + around.places;
                    make_room(buffer, room);
                    let slots = &mut buffer[len..room];
                    len += if grid.is_sorted() && !domain.near_periodic_face(x, reach) {
                        keep_sorted(slots, x, sources, &around.ranges, reach2)
                    } else {
                        let ranges = around.ranges.iter();
                        let members = ranges.flat_map(|range| &grid.order()[range.clone()]);
                        keep(slots, members, |j| {
                            domain.nearest_image(x - sources[j]).norm_squared() < reach2
                        })
                    };
                    block.starts.push(len as u32);
                }
                keep_all(&mut block.candidates, &buffer[..len]);
            });
    }

    /// Counts the sources from another first one.
    pub fn shift(&mut self, first: u32) {
        if first > 0 {
            let all = self.blocks.par_iter_mut();
            all.for_each(|block| block.candidates.iter_mut().for_each(|c| *c += first));
        }
    }

    /// The candidates of a target.
    #[inline(always)]
    pub fn row(&self, i: usize) -> &[u32] {
        let block = &self.blocks[i / CHUNK];
        let k = i % CHUNK;
        &block.candidates[block.starts[k] as usize..block.starts[k + 1] as usize]
    }

    /// Number of targets.
    pub fn len(&self) -> usize {
        self.len
    }

    /// True if there is no target.
    pub fn is_empty(&self) -> bool {
        self.len == 0
    }

    /// Candidates over all targets, skin included.
    pub fn candidates(&self) -> usize {
        let last = |b: &Block| b.starts.last().copied().unwrap_or(0) as usize;
        self.blocks.iter().map(last).sum()
    }

    /// Bytes held.
    pub fn bytes(&self) -> usize {
        let words = |b: &Block| b.candidates.capacity() + b.starts.capacity();
        self.blocks.iter().map(|b| 4 * words(b)).sum()
    }
}

/// The places of a grid around one of its cells; targets that follow one another mostly share them.
#[derive(Default)]
pub(crate) struct CellRanges {
    cell: Option<usize>,
    ranges: Vec<Range<usize>>,
    /// In all ranges.
    places: usize,
}

impl CellRanges {
    /// Looks around the cell of a point, unless that has been done.
    fn go_to<const D: usize>(&mut self, x: &Vect<D>, grid: &CellGrid<D>, reach: f64) {
        let cell = Some(grid.cell_of(x));
        if self.cell == cell {
            return;
        }
        self.cell = cell;
        self.ranges.clear();
        grid.ranges(x, reach, |range| self.ranges.push(range));
        self.places = self.ranges.iter().map(Range::len).sum();
    }
}

/// Writes the members of contiguous ranges that are near; branch-free in the distance test.
///
/// A call of its own: within the loops around it registers would be spilled for every candidate.
#[inline(never)]
fn keep_sorted<const D: usize>(
    slots: &mut [u32],
    x: &Vect<D>,
    sources: &[Vect<D>],
    ranges: &[Range<usize>],
    reach2: f64,
) -> usize {
    let mut n = 0;
    for range in ranges {
        for (j, y) in range.clone().zip(&sources[range.clone()]) {
            let near = (x - y).norm_squared() < reach2;
            slots[n] = j as u32;
            n += usize::from(near);
        }
    }
    n
}

/// Writes the members of a list that are near.
fn keep<'a>(
    slots: &mut [u32],
    members: impl Iterator<Item = &'a u32>,
    near: impl Fn(usize) -> bool,
) -> usize {
    let mut n = 0;
    for &j in members {
        if near(j as usize) {
            slots[n] = j;
            n += 1;
        }
    }
    n
}
