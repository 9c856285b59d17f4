//! Incomplete Cholesky factorisation without fill, for numbers and blocks.

use rayon::prelude::*;
use sph_core::Vect;

use crate::linear::matrix::Values;
use crate::linear::{Entry, Pattern};

/// A ≈ (P + L) P⁻¹ (P + Lᵀ) with L on the lower pattern of A:
/// l_ij = a_ij − Σ_{k<j} l_ik p_k⁻¹ l_jkᵀ, p_i = a_ii − Σ_{k<i} l_ik p_k⁻¹ l_ikᵀ.
///
/// Rows are cut into parts of 2048, whatever the number of threads; what couples parts is left out of L, so that they
/// are factorised and solved side by side. For M-matrices all pivots are positive (Meijerink & van der Vorst 1977).
/// Where one is not, the diagonal of the matrix is raised and the factorisation begun anew.
///
/// L is kept to seven digits, in units of the largest pivot: the factors stay symmetric and positive definite whatever L
/// is, an approximation need not be better, and a solve is the time that it takes to read them.
pub(crate) struct Incomplete<E: Entry<D>, const D: usize> {
    parts: Vec<Part<E, D>>,
}

impl<E: Entry<D>, const D: usize> Default for Incomplete<E, D> {
    fn default() -> Self {
        Incomplete { parts: Vec::new() }
    }
}

/// The factor of some rows that follow each other; columns count from the first of them.
struct Part<E: Entry<D>, const D: usize> {
    starts: Vec<u32>,
    columns: Vec<u16>,
    /// l in units of `largest`.
    lower: Vec<E::Short>,
    inverse_pivots: Vec<E>,
    largest: f64,
    /// l before it is shortened; kept for its memory.
    long: Vec<E>,
}

/// Rows of a part; their number fits into 16 bits.
pub(crate) const PART: usize = 2048;
/// Share by which the diagonal is raised at the first failure; tenfold at every further one.
const RAISE: f64 = 1e-3;
/// Failures after which the matrix is called indefinite.
const ATTEMPTS: usize = 5;

impl<E: Entry<D>, const D: usize> Incomplete<E, D> {
    /// Factorises in the memory of the factors before; with `pivots_only` l_ij = a_ij, which leaves out the search for common columns: less work for more iterations.
    ///
    /// # Errors
    /// The row whose pivot is not positive, even with a raised diagonal.
    pub fn refill(
        &mut self,
        pattern: &Pattern,
        values: &Values<E>,
        pivots_only: bool,
    ) -> Result<&Self, usize> {
        let mut raise = 0.0;
        let mut row = 0;
        let count = pattern.len().div_ceil(PART);
        self.parts.resize_with(count, Part::empty);
        for _ in 0..ATTEMPTS {
            let parts = self.parts.par_iter_mut().enumerate();
            let failed = parts.filter_map(|(k, part)| {
                let filled = part.refill(pattern, values, pivots_only, 1.0 + raise, k);
                filled.err()
            });
            match failed.min() {
                None => return Ok(self),
                Some(i) => row = i,
            }
            raise = if raise == 0.0 { RAISE } else { 10.0 * raise };
        }
        Err(row)
    }

    /// Memory of the factor.
    pub fn bytes(&self) -> usize {
        let part = |p: &Part<E, D>| {
            size_of_val(&p.starts[..])
                + size_of_val(&p.columns[..])
                + size_of_val(&p.lower[..])
                + size_of_val(&p.inverse_pivots[..])
                + size_of_val(&p.long[..])
        };
        self.parts.iter().map(part).sum()
    }

    /// z = (P + Lᵀ)⁻¹ P (P + L)⁻¹ r.
    pub fn solve(&self, r: &[Vect<D>], z: &mut [Vect<D>]) {
        let parts = z.par_chunks_mut(PART).zip(r.par_chunks(PART));
        let parts = parts.zip(&self.parts);
        parts.for_each(|((z, r), part)| part.solve(r, z));
    }
}

impl<E: Entry<D>, const D: usize> Part<E, D> {
    fn empty() -> Self {
        Part {
            starts: Vec::new(),
            columns: Vec::new(),
            lower: Vec::new(),
            inverse_pivots: Vec::new(),
            largest: 0.0,
            long: Vec::new(),
        }
    }

    fn refill(
        &mut self,
        pattern: &Pattern,
        values: &Values<E>,
        pivots_only: bool,
        raise: f64,
        part: usize,
    ) -> Result<(), usize> {
        let Part {
            starts,
            columns,
            inverse_pivots,
            long: lower,
            ..
        } = self;
        let from = part * PART;
        let rows = from..(from + PART).min(pattern.len());
        starts.clear();
        starts.push(0);
        columns.clear();
        // Capacity of the present entries: growing by doubles would keep half of it empty.
        let room = pattern.row(rows.end - 1).end - pattern.row(from).start;
        columns.reserve_exact(room / 2);
        lower.clear();
        lower.reserve_exact(room / 2);
        inverse_pivots.clear();
        let mut largest = f64::MIN_POSITIVE;
        for i in rows {
            let begin = columns.len();
            let row = pattern.row(i);
            let all = &pattern.columns[row.clone()];
            let first = all.partition_point(|j| (*j as usize) < from);
            let last = all.partition_point(|j| (*j as usize) < i);
            columns.extend(all[first..last].iter().map(|j| (j - from as u32) as u16));
            lower.extend(&values.others[row.start + first..row.start + last]);
            largest = largest.max(values.diagonal[i].largest());
            let mut pivot = values.diagonal[i] * raise;
            for k in begin..columns.len() {
                let j = columns[k] as usize;
                let mut entry: E = lower[k];
                // Both rows ascend: merge them.
                let (mut a, mut b) = (if pivots_only { k } else { begin }, starts[j] as usize);
                let end = starts[j + 1] as usize;
                while a < k && b < end {
                    let (ca, cb) = (columns[a], columns[b]);
                    if ca == cb {
                        let middle = &inverse_pivots[ca as usize];
                        entry = entry + lower[a].triple_product(middle, &lower[b]) * -1.0;
                    }
                    a += usize::from(ca <= cb);
                    b += usize::from(cb <= ca);
                }
                lower[k] = entry;
                pivot = pivot + entry.triple_product(&inverse_pivots[j], &entry) * -1.0;
            }
            inverse_pivots.push(pivot.inverted().ok_or(i)?);
            starts.push(columns.len() as u32);
        }
        let factor = 1.0 / largest;
        self.largest = largest;
        self.lower.clear();
        self.lower.reserve_exact(self.long.len());
        self.lower
            .extend(self.long.iter().map(|l| l.to_single(factor)));
        Ok(())
    }

    fn solve(&self, r: &[Vect<D>], z: &mut [Vect<D>]) {
        let row = |i: usize| self.starts[i] as usize..self.starts[i + 1] as usize;
        for i in 0..r.len() {
            let mut sum = Vect::zeros();
            for (l, &j) in self.lower[row(i)].iter().zip(&self.columns[row(i)]) {
                sum += E::long(l).apply(&z[j as usize]);
            }
            z[i] = self.inverse_pivots[i].apply(&(r[i] - sum * self.largest));
        }
        // Column by column from the end: z_j −= P_j⁻¹ l_ijᵀ z_i.
        for i in (0..r.len()).rev() {
            let own = z[i] * self.largest;
            for (l, &j) in self.lower[row(i)].iter().zip(&self.columns[row(i)]) {
                let j = j as usize;
                z[j] -= self.inverse_pivots[j].apply(&E::long(l).apply_transposed(&own));
            }
        }
    }
}
