//! From the clusters of the neighbour lists to a matrix.

use std::ops::Range;
use std::sync::Arc;

use rayon::prelude::*;
use sph_core::{StepError, Vect};
use sph_neighbours::{CHUNK, Cluster, ClusterWalk, World};

use crate::linear::{Entry, Pattern, Values};

/// A matrix of a system of C components, the dimensions of space for velocities, one for a pressure; with its sources,
/// and its parts.
///
/// It is kept from step to step for its memory: to ask for tens of megabytes anew in every step costs a tenth of it.
#[derive(Clone, Debug)]
pub struct Assembly<E, const C: usize> {
    /// Pattern of the entries; a matrix may share it.
    pub pattern: Arc<Pattern>,
    /// Their values.
    pub values: Values<E>,
    /// Parts of the right-hand side, one per row.
    pub sources: Vec<Vect<C>>,
    parts: Vec<Rows<E, C>>,
}

impl<E, const C: usize> Default for Assembly<E, C> {
    fn default() -> Self {
        Assembly {
            pattern: Arc::default(),
            values: Values::default(),
            sources: Vec::new(),
            parts: Vec::new(),
        }
    }
}

/// The rows of a block of particles, one after the other.
#[derive(Clone, Debug)]
pub struct Rows<E, const C: usize> {
    /// Entries of each row that is finished.
    counts: Vec<u32>,
    /// Room for columns; of the rows so far `used` are taken.
    columns: Vec<u32>,
    /// Room for −c in the same order.
    others: Vec<E>,
    used: usize,
    /// First entry of the row at hand.
    begin: usize,
    diagonal: Vec<E>,
    sources: Vec<Vect<C>>,
}

impl<E: Entry<C>, const C: usize> Rows<E, C> {
    fn new() -> Self {
        Rows {
            counts: Vec::with_capacity(CHUNK),
            columns: Vec::new(),
            others: Vec::new(),
            used: 0,
            begin: 0,
            diagonal: Vec::with_capacity(CHUNK),
            sources: Vec::with_capacity(CHUNK),
        }
    }

    fn clear(&mut self) {
        self.counts.clear();
        self.diagonal.clear();
        self.sources.clear();
        (self.used, self.begin) = (0, 0);
    }

    /// Begins a row of at most `most` couplings.
    #[inline]
    pub fn begin(&mut self, most: usize) {
        self.begin = self.used;
        let needed = self.used + most + 1;
        if self.columns.len() < needed {
            let room = needed + needed / 8;
            self.columns.reserve_exact(room - self.columns.len());
            self.columns.resize(room, 0);
            self.others.reserve_exact(room - self.others.len());
            self.others.resize(room, E::ZERO);
        }
    }

    /// Couples the row to that of `j` by c, if it `counts`; there must be room for one more in any case.
    #[inline(always)]
    pub fn couple(&mut self, j: u32, c: &E, counts: bool) {
        self.columns[self.used] = j;
        self.others[self.used] = *c * -1.0;
        self.used += usize::from(counts);
    }

    /// The couplings of the row at hand, with their sign turned.
    #[inline(always)]
    fn own(&self) -> &[E] {
        &self.others[self.begin..self.used]
    }

    /// Ends the row at hand: `own` stands on the diagonal besides the sum of the couplings, `source` on the right-hand side.
    #[inline]
    pub fn end(&mut self, own: E, source: Vect<C>) {
        let diagonal = self.own().iter().fold(own, |sum, c| sum + *c * -1.0);
        self.close(diagonal, source);
    }

    /// Ends the row at hand, whose diagonal is known.
    #[inline]
    pub fn close(&mut self, diagonal: E, source: Vect<C>) {
        self.diagonal.push(diagonal);
        self.sources.push(source);
        self.counts.push((self.used - self.begin) as u32);
        let columns = &self.columns[self.begin..self.used];
        if !columns.is_sorted() {
            self.sort();
        }
        self.begin = self.used;
    }

    /// Sorts the row at hand: lists of particles that are not sorted.
    #[cold]
    fn sort(&mut self) {
        let row = self.begin..self.used;
        let columns = self.columns[row.clone()].iter().copied();
        let mut both: Vec<(u32, E)> = columns.zip(self.own().iter().copied()).collect();
        both.sort_by_key(|(j, _)| *j);
        for (k, (j, c)) in row.zip(both) {
            (self.columns[k], self.others[k]) = (j, c);
        }
    }
}

impl<E: Entry<C>, const C: usize> Assembly<E, C> {
    /// Fills it with −c_ij beside and own_i + Σ_j c_ij on the diagonal, and the sources.
    ///
    /// `cluster` adds a row for each member of a cluster, in their order, `others` for each of one in which no member is
    /// `wanted`: no neighbours are searched there.
    ///
    /// # Errors
    /// If the world has no positions.
    pub fn fill_wanted<const D: usize>(
        &mut self,
        world: &World<D>,
        wanted: impl Fn(usize) -> bool + Sync,
        cluster: impl Fn(&mut Rows<E, C>, &mut Cluster<'_, D>) + Sync,
        others: impl Fn(&mut Rows<E, C>, Range<usize>) + Sync,
    ) -> Result<(), StepError> {
        let walk = ClusterWalk::new(world)?;
        self.fill_blocks([walk.blocks(), walk.particles()], |block, rows| {
            walk.each_wanted(block, rows, &wanted, &cluster, &others);
        });
        Ok(())
    }

    /// The same of so many blocks with so many rows in all; `add` adds the rows of a block.
    pub fn fill_blocks(
        &mut self,
        [blocks, all]: [usize; 2],
        add: impl Fn(usize, &mut Rows<E, C>) + Sync,
    ) {
        self.parts.resize_with(blocks, Rows::new);
        let blocks = self.parts.par_iter_mut().enumerate();
        blocks.for_each(|(block, rows)| {
            rows.clear();
            add(block, rows);
        });
        self.join(all);
    }

    /// Memory of pattern and values.
    pub fn bytes(&self) -> usize {
        let entries = size_of_val(&self.values.diagonal[..]) + size_of_val(&self.values.others[..]);
        size_of_val(&self.pattern.starts[..]) + size_of_val(&self.pattern.columns[..]) + entries
    }

    /// Moves the rows of all parts to where a matrix has them.
    fn join(&mut self, rows: usize) {
        let Assembly {
            pattern,
            values,
            sources,
            parts,
        } = self;
        let entries = parts.iter().map(|p| p.used).sum();
        if Arc::get_mut(pattern).is_none() {
            // A factorisation still has the last one.
            *pattern = Arc::default();
        }
        let Some(pattern) = Arc::get_mut(pattern) else {
            unreachable!("it is not shared yet");
        };
        pattern.starts.clear();
        pattern.starts.reserve(rows + 1);
        pattern.starts.push(0);
        values.diagonal.clear();
        values.diagonal.reserve(rows);
        sources.clear();
        sources.reserve(rows);
        let mut start = 0;
        for part in parts.iter() {
            for count in &part.counts {
                start += count;
                pattern.starts.push(start);
            }
            values.diagonal.extend_from_slice(&part.diagonal);
            sources.extend_from_slice(&part.sources);
        }
        make_room(&mut pattern.columns, entries, 0);
        make_room(&mut values.others, entries, E::ZERO);
        copy(parts, &mut pattern.columns, &mut values.others);
    }
}

/// Blocks that one task copies.
const TOGETHER: usize = 32;

/// Copies the entries of parts one after the other.
fn copy<E: Copy + Send + Sync, const C: usize>(
    parts: &[Rows<E, C>],
    columns: &mut [u32],
    others: &mut [E],
) {
    if parts.len() > TOGETHER {
        let (left, right) = parts.split_at(parts.len() / 2);
        let entries = left.iter().map(|p| p.used).sum();
        let (left_columns, right_columns) = columns.split_at_mut(entries);
        let (left_others, right_others) = others.split_at_mut(entries);
        rayon::join(
            || copy(left, left_columns, left_others),
            || copy(right, right_columns, right_others),
        );
        return;
    }
    let mut from = 0;
    for part in parts {
        let own = from..from + part.used;
        columns[own.clone()].copy_from_slice(&part.columns[..part.used]);
        others[own].copy_from_slice(&part.others[..part.used]);
        from += part.used;
    }
}

/// As many entries as are needed, in a buffer that is at most a quarter too large.
fn make_room<T: Clone>(held: &mut Vec<T>, needed: usize, nothing: T) {
    if needed > held.capacity() {
        held.clear();
        held.reserve_exact(needed + needed / 16);
    }
    held.resize(needed, nothing);
}
