//! A symmetric matrix with each pair once, for many products.

use rayon::prelude::*;
use sph_core::Vect;

use crate::linear::matrix::{Entries, Values};
use crate::linear::{Block, Entry, Matrix, Pattern};

/// Least number of rows of a part.
const PART: usize = 2048;
/// Parts of a large matrix, so that threads have even shares.
const PARTS: usize = 32;
/// Rows of a part whose numbers fit into 16 bits.
const MOST: usize = 1 << 16;

/// The same operator as a [`Matrix`], read in 0.6 to 0.7 of the time: of pairs within a part of rows there is one entry.
///
/// The parts depend on the number of rows alone, and so does the order of the sums: by rounding another one than the matrix has.
pub enum Halved<'a, const D: usize> {
    /// Numbers.
    Scalar(Parts<'a, f64>),
    /// Blocks.
    Block(Parts<'a, Block<D>>),
}

/// The memory of halved matrices.
#[derive(Default)]
pub struct Halves<const D: usize> {
    scalar: Vec<Part<f64>>,
    block: Vec<Part<Block<D>>>,
}

impl<'a, const D: usize> Halved<'a, D> {
    /// Of a matrix, in the memory of one before.
    pub(crate) fn new(matrix: &'a Matrix<D>, memory: &'a mut Halves<D>) -> Self {
        let Matrix { pattern, entries } = matrix;
        match entries {
            Entries::Scalar(own) => Halved::Scalar(halve::<_, D>(pattern, own, &mut memory.scalar)),
            Entries::Block(own) => Halved::Block(halve::<_, D>(pattern, own, &mut memory.block)),
        }
    }

    /// y = A x.
    pub fn multiply(&self, x: &[Vect<D>], y: &mut [Vect<D>]) {
        match self {
            Halved::Scalar(parts) => multiply(parts, x, y),
            Halved::Block(parts) => multiply(parts, x, y),
        }
    }
}

/// The parts of a matrix.
pub struct Parts<'a, E> {
    diagonal: &'a [E],
    rows: usize,
    parts: &'a [Part<E>],
}

/// Some rows that follow each other.
struct Part<E> {
    /// Start of the entries of each row: those left of the diagonal within the part, and those outside of it.
    starts: Vec<[u32; 2]>,
    /// Columns within the part, counted from its first row.
    inside: Vec<u16>,
    lower: Vec<E>,
    outside: Vec<u32>,
    others: Vec<E>,
}

fn halve<'a, E: Entry<D>, const D: usize>(
    pattern: &Pattern,
    values: &'a Values<E>,
    parts: &'a mut Vec<Part<E>>,
) -> Parts<'a, E> {
    let rows = pattern.len().div_ceil(PARTS).clamp(PART, MOST);
    parts.resize_with(pattern.len().div_ceil(rows), Part::empty);
    parts.par_iter_mut().enumerate().for_each(|(k, part)| {
        let own = k * rows..((k + 1) * rows).min(pattern.len());
        part.refill(pattern, &values.others, own);
    });
    Parts {
        diagonal: &values.diagonal,
        rows,
        parts,
    }
}

fn multiply<E: Entry<D>, const D: usize>(all: &Parts<'_, E>, x: &[Vect<D>], y: &mut [Vect<D>]) {
    let parts = y.par_chunks_mut(all.rows).zip(all.parts).enumerate();
    parts.for_each(|(k, (y, part))| {
        let from = k * all.rows;
        part.multiply(&all.diagonal[from..from + y.len()], &x[from..], x, y);
    });
}

impl<E: Copy> Part<E> {
    fn empty() -> Self {
        Part {
            starts: Vec::new(),
            inside: Vec::new(),
            lower: Vec::new(),
            outside: Vec::new(),
            others: Vec::new(),
        }
    }

    fn refill(&mut self, pattern: &Pattern, others: &[E], own: std::ops::Range<usize>) {
        let part = self;
        part.starts.clear();
        part.inside.clear();
        part.lower.clear();
        part.outside.clear();
        part.others.clear();
        // Capacity of the present entries: growing by doubles would keep half of it empty.
        let room = pattern.starts[own.end] as usize - pattern.starts[own.start] as usize;
        part.starts.reserve_exact(own.len() + 1);
        part.inside.reserve_exact(room / 2);
        part.lower.reserve_exact(room / 2);
        part.starts.push([0, 0]);
        for i in own.clone() {
            let row = pattern.row(i);
            let columns = &pattern.columns[row.clone()];
            let bound = |limit: usize| columns.partition_point(|j| (*j as usize) < limit);
            let [first, middle, last] = [own.start, i, own.end].map(bound);
            let entries = &others[row];
            let inside = columns[first..middle].iter();
            let inside = inside.map(|j| (*j as usize - own.start) as u16);
            part.inside.extend(inside);
            part.lower.extend_from_slice(&entries[first..middle]);
            for range in [0..first, last..columns.len()] {
                part.outside.extend_from_slice(&columns[range.clone()]);
                part.others.extend_from_slice(&entries[range]);
            }
            let ends = [part.inside.len() as u32, part.outside.len() as u32];
            part.starts.push(ends);
        }
    }

    /// y = A x for the rows of the part, of which `own` are the x.
    fn multiply<const D: usize>(
        &self,
        diagonal: &[E],
        own: &[Vect<D>],
        x: &[Vect<D>],
        y: &mut [Vect<D>],
    ) where
        E: Entry<D>,
    {
        for (i, d) in diagonal.iter().enumerate() {
            let [from, to] = [self.starts[i], self.starts[i + 1]];
            let within = from[0] as usize..to[0] as usize;
            let beyond = from[1] as usize..to[1] as usize;
            let here = own[i];
            let mut sum = d.apply(&here);
            let pairs = self.lower[within.clone()].iter().zip(&self.inside[within]);
            for (a, &j) in pairs {
                let j = j as usize;
                sum += a.apply(&own[j]);
                y[j] += a.apply_transposed(&here);
            }
            let entries = self.others[beyond.clone()].iter();
            for (a, &j) in entries.zip(&self.outside[beyond]) {
                sum += a.apply(&x[j as usize]);
            }
            y[i] = sum;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Rows coupled to some before and after them, within parts and across; blocks that are not symmetric themselves.
    fn matrix(rows: u32) -> Matrix<2> {
        let steps = [1, 2, 45, 1999, 5000];
        let near = |i: u32| {
            let before = steps.iter().rev().filter_map(move |s| i.checked_sub(*s));
            let after = steps.iter().map(move |s| i + s).filter(move |j| *j < rows);
            before.chain(after).collect::<Vec<_>>()
        };
        let pattern = Pattern::from_rows(&(0..rows).map(near).collect::<Vec<_>>());
        let block = |i: u32, j: u32| {
            let (low, high) = (f64::from(i.min(j)), f64::from(i.max(j)));
            let block = Block::<2>::new(low.sin(), high.cos(), (low + 2.0 * high).sin(), 0.3);
            if i < j { block } else { block.transpose() }
        };
        let others = (0..rows).flat_map(|i| near(i).into_iter().map(move |j| block(i, j)));
        let others = others.collect();
        let diagonal = (0..rows).map(|i| Block::<2>::identity() * f64::from(i % 7 + 9));
        Matrix::new(pattern, Entries::block(diagonal.collect(), others))
    }

    #[test]
    fn products_are_those_of_the_matrix_to_rounding() {
        let rows = 7001;
        let matrix = matrix(rows);
        assert_eq!(matrix.asymmetry(), 0.0);
        let one = |i| Vect::<2>::new(f64::from(i).sin(), f64::from(3 * i).cos());
        let x: Vec<_> = (0..rows).map(one).collect();
        let [mut whole, mut halved] = [0.0, f64::NAN].map(|y| vec![Vect::repeat(y); rows as usize]);
        matrix.multiply(&x, &mut whole);
        Halved::new(&matrix, &mut Halves::default()).multiply(&x, &mut halved);
        let apart = whole.iter().zip(&halved);
        let apart = apart.map(|(a, b)| (a - b).amax()).fold(0.0, f64::max);
        assert!(apart < 1e-13, "{apart:e}");
    }
}
