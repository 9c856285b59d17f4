//! Verlet lists of clusters: particles that follow each other share the union of their neighbours.

use std::ops::Range;

use rayon::prelude::*;
use sph_core::{Pool, Vect};
use sph_kernels::lanes::{Body, Lane, dispatch_at, dot, width};

use crate::lanes::separation::places;
use crate::lists::buffer::{grow, keep_all};
use crate::lists::members::Members;
use crate::{CellGrid, Domain, minus};

/// Particles that one task works through; also the granule of the lists.
pub const CHUNK: usize = 64;

/// A cluster ends where its box would be longer than this many reaches: at the ends of rows of cells, in splashes.
const LONGEST: f64 = 1.5;

#[derive(Clone, Debug, Default)]
struct Block {
    /// Begin of each cluster, counted from the block's first particle; the number of particles at the end.
    first: Vec<u8>,
    /// Begin of the candidates of each cluster, and the end of the last ones.
    starts: Vec<u32>,
    candidates: Vec<u32>,
    /// The cluster of each particle.
    of: Vec<u8>,
}

type TaskScratch = (Vec<u32>, Vec<Range<usize>>);

/// For every free particle, or place on a wall, the free particles that may be within reach: one list for a cluster of at
/// most [`MOST`](sph_kernels::lanes::MOST) that follow each other.
#[derive(Clone, Debug, Default)]
pub struct Clusters {
    blocks: Vec<Block>,
    len: usize,
}

impl Clusters {
    /// Finds, for every cluster of targets that follow each other, the points nearer than `reach` to any of its members; none
    /// around clusters all of whose members are `idle`: no sum of theirs is needed.
    ///
    /// The candidates stand in the grid's cell order, which is index order where the points are sorted.
    pub fn build<const D: usize>(
        &mut self,
        points: [&[Vect<D>]; 2],
        grid: &CellGrid<D>,
        within: (f64, &Domain<D>),
        pool: &Pool<TaskScratch>,
        idle: Option<&[bool]>,
    ) {
        self.build_of(width().lanes(), points, grid, within, pool, idle);
    }

    /// The same with a list for each target alone.
    pub fn build_each<const D: usize>(
        &mut self,
        points: [&[Vect<D>]; 2],
        grid: &CellGrid<D>,
        within: (f64, &Domain<D>),
        pool: &Pool<TaskScratch>,
    ) {
        self.build_of(1, points, grid, within, pool, None);
    }

    fn build_of<const D: usize>(
        &mut self,
        most: usize,
        [targets, points]: [&[Vect<D>]; 2],
        grid: &CellGrid<D>,
        (reach, domain): (f64, &Domain<D>),
        pool: &Pool<TaskScratch>,
        idle: Option<&[bool]>,
    ) {
        self.resize(targets.len());
        let width = width();
        let blocks = self.blocks.par_iter_mut().enumerate();
        blocks.for_each_init(
            || pool.acquire(),
            |room, (b, block)| {
                let (slots, ranges) = &mut **room;
                let from = b * CHUNK;
                let to = (from + CHUNK).min(targets.len());
                block.part(&targets[from..to], most, LONGEST * reach);
                let (mut used, mut last_cell) = (0, None);
                for c in 0..block.clusters() {
                    let [first, count] = block.span(c, from);
                    let members = first..first + count;
                    if !idle.is_some_and(|idle| idle[members.clone()].iter().all(|idle| *idle)) {
                        let own = &targets[members];
                        // Points of one cell share their ranges.
                        let cell = (count == 1).then(|| grid.cell_of(&own[0]));
                        if cell.is_none() || cell != last_cell {
                            grid.ranges_into(own, reach, ranges);
                            last_cell = cell;
                        }
                        let search = CandidateSearch {
                            own,
                            points,
                            grid,
                            reach,
                            domain,
                            from: used,
                            slots,
                            ranges,
                        };
                        used = dispatch_at(width, search);
                    }
                    block.starts.push(used as u32);
                }
                keep_all(&mut block.candidates, &slots[..used]);
            },
        );
    }

    /// Counts the points from another first one.
    pub(crate) fn shift(&mut self, first: u32) {
        if first > 0 {
            let all = self.blocks.par_iter_mut();
            all.for_each(|block| block.candidates.iter_mut().for_each(|c| *c += first));
        }
    }

    /// For as many particles, with buffers that are kept.
    fn resize(&mut self, particles: usize) {
        self.len = particles;
        let blocks = particles.div_ceil(CHUNK);
        self.blocks.resize_with(blocks, Block::default);
    }

    /// Fills `self` with the clusters of `all`, cluster by cluster in parallel, and one number per particle along with it.
    /// `cluster` gets the members, room for as many candidates as they have and the members' numbers, and returns how many
    /// candidates it left.
    pub(crate) fn fill<S: Default + Send>(
        &mut self,
        all: &Clusters,
        numbers: &mut [f64],
        pool: &Pool<(S, Vec<u32>)>,
        cluster: impl Fn(&mut S, Members<'_>, &mut [u32], &mut [f64]) -> usize + Sync,
    ) {
        self.resize(all.len);
        let blocks = self.blocks.par_iter_mut().zip(&all.blocks);
        blocks
            .zip(numbers.par_chunks_mut(CHUNK))
            .enumerate()
            .for_each_init(
                || pool.acquire(),
                |room, (b, ((block, all), numbers))| {
                    let (scratch, buffer) = &mut **room;
                    block.begin(all);
                    buffer.resize(buffer.len().max(all.candidates.len()), 0);
                    let mut used = 0;
                    for c in 0..all.clusters() {
                        let members = all.members(c, b * CHUNK);
                        let first = members.from - b * CHUNK;
                        let own = first..first + members.count;
                        let room = &mut buffer[used..used + members.candidates.len()];
                        used += cluster(scratch, members, room, &mut numbers[own]);
                        block.starts.push(used as u32);
                    }
                    keep_all(&mut block.candidates, &buffer[..used]);
                },
            );
    }

    /// The clusters of a block of [`CHUNK`] particles.
    #[inline]
    pub(crate) fn of_block(&self, block: usize) -> impl Iterator<Item = Members<'_>> {
        let (from, block) = (block * CHUNK, &self.blocks[block]);
        (0..block.clusters()).map(move |c| block.members(c, from))
    }

    /// Candidates of the cluster of a particle, itself among them, or of a place.
    #[inline(always)]
    pub fn candidates(&self, particle: usize) -> &[u32] {
        let block = &self.blocks[particle / CHUNK];
        block.row(block.of[particle % CHUNK] as usize)
    }

    /// Number of particles or places.
    pub fn len(&self) -> usize {
        self.len
    }

    /// True if there are none.
    pub fn is_empty(&self) -> bool {
        self.len == 0
    }

    /// Entries of all lists.
    pub fn entries(&self) -> usize {
        self.blocks.iter().map(|b| b.candidates.len()).sum()
    }
}

impl Block {
    fn clusters(&self) -> usize {
        self.first.len().saturating_sub(1)
    }

    /// First particle and number of particles of a cluster.
    fn span(&self, cluster: usize, from: usize) -> [usize; 2] {
        let [first, next] = [cluster, cluster + 1].map(|c| self.first[c] as usize);
        [from + first, next - first]
    }

    #[inline(always)]
    fn row(&self, cluster: usize) -> &[u32] {
        &self.candidates[self.starts[cluster] as usize..self.starts[cluster + 1] as usize]
    }

    fn members(&self, cluster: usize, from: usize) -> Members<'_> {
        let [from, count] = self.span(cluster, from);
        let candidates = self.row(cluster);
        Members {
            from,
            count,
            candidates,
        }
    }

    /// Parts points into clusters of at most `width` that are not longer than `longest`, and clears all candidates.
    fn part<const D: usize>(&mut self, points: &[Vect<D>], width: usize, longest: f64) {
        self.first.clear();
        self.of.clear();
        let (mut begun, mut low, mut high) = (0, Vect::<D>::zeros(), Vect::<D>::zeros());
        for (k, x) in points.iter().enumerate() {
            (low, high) = (low.inf(x), high.sup(x));
            let fits = (high - low).iter().all(|side| *side <= longest);
            if k == 0 || k - begun == width || !fits {
                self.first.push(k as u8);
                (begun, low, high) = (k, *x, *x);
            }
            self.of.push(self.first.len() as u8 - 1);
        }
        self.first.push(points.len() as u8);
        self.starts.clear();
        self.starts.push(0);
    }

    /// The same clusters as another, without candidates.
    fn begin(&mut self, other: &Block) {
        self.first.clone_from(&other.first);
        self.of.clone_from(&other.of);
        self.starts.clear();
        self.starts.push(0);
    }
}

struct CandidateSearch<'a, const D: usize> {
    own: &'a [Vect<D>],
    points: &'a [Vect<D>],
    grid: &'a CellGrid<D>,
    reach: f64,
    domain: &'a Domain<D>,
    /// Slots that are filled already.
    from: usize,
    slots: &'a mut Vec<u32>,
    ranges: &'a [Range<usize>],
}

impl<const D: usize> Body for CandidateSearch<'_, D> {
    type Output = usize;

    #[inline(always)]
    fn call<L: Lane>(self) -> usize {
        let CandidateSearch { own, ranges, .. } = self;
        let room = self.from + ranges.iter().map(Range::len).sum::<usize>();
        grow(self.slots, room);
        let slots = &mut self.slots[self.from..room];
        let limit = self.reach * self.reach;
        let crosses = own
            .iter()
            .any(|x| self.domain.near_periodic_face(x, self.reach));
        let mut n = 0;
        if crosses || !self.grid.is_sorted() || own.len() > L::N {
            for range in ranges {
                for &j in &self.grid.order()[range.clone()] {
                    let near = |x: &Vect<D>| {
                        let apart = self.domain.nearest_image(x - self.points[j as usize]);
                        apart.norm_squared() < limit
                    };
                    slots[n] = j;
                    n += usize::from(own.iter().any(near));
                }
            }
            return self.from + n;
        }
        let x = places::<D, L>(own);
        let limit = L::splat(limit);
        for range in ranges {
            for j in range.clone() {
                slots[n] = j as u32;
                let apart = minus(&x, &self.points[j]);
                n += usize::from(dot(&apart, &apart).any_less(limit));
            }
        }
        self.from + n
    }
}
