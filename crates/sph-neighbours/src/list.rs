//! Verlet lists: candidates within the support plus a skin, in cell order.

use rayon::prelude::*;
use sph_core::Vect;

use crate::{CellGrid, Domain};

/// Particles that one task works through; also the granule of the lists.
pub const CHUNK: usize = 64;

#[derive(Clone, Debug, Default)]
struct Block {
    starts: Vec<u32>,
    candidates: Vec<u32>,
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
    /// `skip_self` leaves out the source with the target's own index. The candidates stand in
    /// the grid's cell order, which is index order where the sources are sorted.
    pub fn build<const D: usize>(
        &mut self,
        targets: &[Vect<D>],
        sources: &[Vect<D>],
        grid: &CellGrid<D>,
        reach: f64,
        domain: &Domain<D>,
        skip_self: bool,
    ) {
        self.len = targets.len();
        self.blocks
            .resize_with(targets.len().div_ceil(CHUNK), Block::default);
        let reach2 = reach * reach;
        self.blocks
            .par_iter_mut()
            .enumerate()
            .for_each(|(b, block)| {
                block.starts.clear();
                block.candidates.clear();
                block.starts.push(0);
                let from = b * CHUNK;
                let to = (from + CHUNK).min(targets.len());
                for (i, x) in targets[from..to].iter().enumerate() {
                    let own = if skip_self { from + i } else { usize::MAX };
                    let wraps = domain.near_periodic_face(x, reach);
                    grid.ranges(x, reach, |range| {
                        if grid.is_sorted() && !wraps {
                            push_sorted(&mut block.candidates, x, sources, range, reach2, own);
                        } else {
                            for &j in &grid.order()[range] {
                                let d = domain.nearest_image(x - sources[j as usize]);
                                if d.norm_squared() < reach2 && j as usize != own {
                                    block.candidates.push(j);
                                }
                            }
                        }
                    });
                    block.starts.push(block.candidates.len() as u32);
                }
            });
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

    /// Whether there is no target.
    pub fn is_empty(&self) -> bool {
        self.len == 0
    }

    /// Candidates over all targets, skin included.
    pub fn candidates(&self) -> usize {
        self.blocks.iter().map(|b| b.candidates.len()).sum()
    }

    /// Bytes held.
    pub fn bytes(&self) -> usize {
        let words = |b: &Block| b.candidates.capacity() + b.starts.capacity();
        self.blocks.iter().map(|b| 4 * words(b)).sum()
    }
}

/// Appends the members of a contiguous range that are near; branch-free in the distance test.
fn push_sorted<const D: usize>(
    out: &mut Vec<u32>,
    x: &Vect<D>,
    sources: &[Vect<D>],
    range: std::ops::Range<usize>,
    reach2: f64,
    own: usize,
) {
    let base = out.len();
    out.resize(base + range.len(), 0);
    let slots = &mut out[base..];
    let mut n = 0;
    for (j, y) in range.clone().zip(&sources[range]) {
        let near = (x - y).norm_squared() < reach2 && j != own;
        slots[n] = j as u32;
        n += usize::from(near);
    }
    out.truncate(base + n);
}
