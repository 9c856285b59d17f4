//! A square matrix over particles: one diagonal entry and one row of neighbours each.

use std::ops::Range;
use std::sync::Arc;

use rayon::prelude::*;
use sph_core::Vect;

use crate::linear::{Block, Entry};

/// Rows that one task works through.
pub(crate) const ROWS: usize = 256;

/// Pairs of coupled particles without the diagonal; columns ascend within rows.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Pattern {
    /// First entry of every row, one more than there are rows.
    pub starts: Vec<u32>,
    /// Columns.
    pub columns: Vec<u32>,
}

impl Pattern {
    /// From the columns of every row, in ascending order.
    pub fn from_rows(rows: &[Vec<u32>]) -> Self {
        let mut pattern = Pattern {
            starts: vec![0],
            columns: Vec::new(),
        };
        for row in rows {
            pattern.columns.extend(row);
            pattern.starts.push(pattern.columns.len() as u32);
        }
        pattern
    }

    /// Number of rows.
    pub fn len(&self) -> usize {
        self.starts.len().saturating_sub(1)
    }

    /// True if there is no row.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Entries of a row.
    #[inline(always)]
    pub fn row(&self, i: usize) -> Range<usize> {
        self.starts[i] as usize..self.starts[i + 1] as usize
    }
}

/// Numbers or blocks on a pattern.
#[derive(Clone, Debug)]
pub struct Values<E> {
    /// One per row.
    pub diagonal: Vec<E>,
    /// One per entry of the pattern.
    pub others: Vec<E>,
}

impl<E> Default for Values<E> {
    fn default() -> Self {
        Values {
            diagonal: Vec::new(),
            others: Vec::new(),
        }
    }
}

/// The entries of a matrix.
#[derive(Clone, Debug)]
pub enum Entries<const D: usize> {
    /// The same number for all components: d systems with one matrix.
    Scalar(Values<f64>),
    /// Components are coupled.
    Block(Values<Block<D>>),
}

impl<const D: usize> Entries<D> {
    /// Numbers.
    pub fn scalar(diagonal: Vec<f64>, others: Vec<f64>) -> Self {
        Entries::Scalar(Values { diagonal, others })
    }
    /// Blocks.
    pub fn block(diagonal: Vec<Block<D>>, others: Vec<Block<D>>) -> Self {
        Entries::Block(Values { diagonal, others })
    }
    /// Those of the diagonal.
    pub fn diagonal(&self) -> Diagonal<'_, D> {
        match self {
            Entries::Scalar(values) => Diagonal::Scalar(&values.diagonal),
            Entries::Block(values) => Diagonal::Block(&values.diagonal),
        }
    }
}

/// The diagonal of a matrix, one entry per row.
#[derive(Clone, Copy, Debug)]
pub enum Diagonal<'a, const D: usize> {
    /// The same number for all components.
    Scalar(&'a [f64]),
    /// Components are coupled.
    Block(&'a [Block<D>]),
}

/// A symmetric matrix; both triangles are stored.
#[derive(Clone, Debug)]
pub struct Matrix<const D: usize> {
    /// Pattern of the entries.
    pub pattern: Arc<Pattern>,
    /// Their values.
    pub entries: Entries<D>,
}

impl<const D: usize> Matrix<D> {
    /// Entries on a pattern.
    pub fn new(pattern: Pattern, entries: Entries<D>) -> Self {
        Matrix {
            pattern: Arc::new(pattern),
            entries,
        }
    }

    /// Entries on a pattern that is shared.
    pub fn on(pattern: Arc<Pattern>, entries: Entries<D>) -> Self {
        Matrix { pattern, entries }
    }

    /// Number of rows.
    pub fn rows(&self) -> usize {
        self.pattern.len()
    }

    /// Memory of entries and pattern.
    pub fn bytes(&self) -> usize {
        let entry = match &self.entries {
            Entries::Scalar(_) => size_of::<f64>(),
            Entries::Block(_) => size_of::<Block<D>>(),
        };
        let (rows, others) = (self.rows(), self.pattern.columns.len());
        (rows + others) * entry + (rows + 1 + others) * size_of::<u32>()
    }

    /// y = A x.
    pub fn multiply(&self, x: &[Vect<D>], y: &mut [Vect<D>]) {
        match &self.entries {
            Entries::Scalar(values) => multiply(&self.pattern, values, x, y),
            Entries::Block(values) => multiply(&self.pattern, values, x, y),
        }
    }

    /// max |A − Aᵀ| over max |A|.
    pub fn asymmetry(&self) -> f64 {
        match &self.entries {
            Entries::Scalar(values) => asymmetry::<_, D>(&self.pattern, values),
            Entries::Block(values) => asymmetry(&self.pattern, values),
        }
    }

    /// Largest ratio of the couplings of a row to the rest of its diagonal, Σ|a_ij|/(a_ii − Σ|a_ij|); of blocks with
    /// the means of their diagonals.
    pub fn stiffness(&self) -> f64 {
        match &self.entries {
            Entries::Scalar(values) => stiffness::<_, D>(&self.pattern, values),
            Entries::Block(values) => stiffness(&self.pattern, values),
        }
    }
}

fn multiply<E: Entry<D>, const D: usize>(
    pattern: &Pattern,
    Values { diagonal, others }: &Values<E>,
    x: &[Vect<D>],
    y: &mut [Vect<D>],
) {
    let rows = y.par_iter_mut().enumerate().with_min_len(ROWS);
    rows.for_each(|(i, y)| {
        let range = pattern.row(i);
        let mut sum = diagonal[i].apply(&x[i]);
        for (a, &j) in others[range.clone()].iter().zip(&pattern.columns[range]) {
            sum += a.apply(&x[j as usize]);
        }
        *y = sum;
    });
}

fn asymmetry<E: Entry<D>, const D: usize>(
    pattern: &Pattern,
    Values { diagonal, others }: &Values<E>,
) -> f64 {
    let mirrored = |i: usize, j: usize| {
        let row = pattern.row(j);
        let place = pattern.columns[row.clone()].binary_search(&(i as u32));
        place.map_or(E::ZERO, |k| others[row.start + k])
    };
    let (mut apart, mut all) = (0.0_f64, 0.0_f64);
    for (i, own) in diagonal.iter().enumerate() {
        apart = apart.max((*own + own.transposed() * -1.0).largest());
        all = all.max(own.largest());
        for k in pattern.row(i) {
            let other = mirrored(i, pattern.columns[k] as usize).transposed();
            apart = apart.max((others[k] + other * -1.0).largest());
            all = all.max(others[k].largest());
        }
    }
    if all > 0.0 { apart / all } else { 0.0 }
}

fn stiffness<E: Entry<D>, const D: usize>(
    pattern: &Pattern,
    Values { diagonal, others }: &Values<E>,
) -> f64 {
    let row = |i: usize| {
        let coupled = others[pattern.row(i)].iter().map(|a| a.mean().abs()).sum();
        coupling_ratio(coupled, diagonal[i].mean() - coupled)
    };
    let all = (0..pattern.len()).into_par_iter().with_min_len(ROWS);
    all.map(row).reduce(|| 0.0, f64::max)
}

/// Ratio of the couplings of a row to the rest of its diagonal.
pub(crate) fn coupling_ratio(coupled: f64, left: f64) -> f64 {
    match coupled > 0.0 {
        true if left > 0.0 => coupled / left,
        true => f64::INFINITY,
        false => 0.0,
    }
}
