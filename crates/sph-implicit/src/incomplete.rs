//! Incomplete Cholesky factorisation without fill, for numbers and blocks.

use sph_core::Vect;

use crate::matrix::Values;
use crate::{Entry, Pattern};

/// A ≈ (P + L) P⁻¹ (P + Lᵀ) with L on the lower pattern of A:
/// l_ij = a_ij − Σ_{k<j} l_ik p_k⁻¹ l_jkᵀ, p_i = a_ii − Σ_{k<i} l_ik p_k⁻¹ l_ikᵀ.
///
/// For M-matrices all pivots are positive (Meijerink & van der Vorst 1977). Where one is not, the
/// diagonal of the matrix is raised and the factorisation begun anew.
#[derive(Clone, Debug)]
pub struct Incomplete<E> {
    /// Lower pattern.
    starts: Vec<u32>,
    columns: Vec<u32>,
    lower: Vec<E>,
    inverse_pivots: Vec<E>,
}

/// By what share the diagonal is raised at the first failure; tenfold at every further one.
const RAISE: f64 = 1e-3;
/// Failures after which the matrix is called indefinite.
const ATTEMPTS: usize = 5;

impl<E: Copy> Incomplete<E> {
    /// Factorises.
    ///
    /// # Errors
    /// The row whose pivot is not positive, even with a raised diagonal.
    pub fn new<const D: usize>(pattern: &Pattern, values: &Values<E>) -> Result<Self, usize>
    where
        E: Entry<D>,
    {
        let mut raise = 0.0;
        let mut row = 0;
        for _ in 0..ATTEMPTS {
            match Self::raised::<D>(pattern, values, 1.0 + raise) {
                Ok(factor) => return Ok(factor),
                Err(i) => row = i,
            }
            raise = if raise == 0.0 { RAISE } else { 10.0 * raise };
        }
        Err(row)
    }

    fn raised<const D: usize>(
        pattern: &Pattern,
        values: &Values<E>,
        raise: f64,
    ) -> Result<Self, usize>
    where
        E: Entry<D>,
    {
        let n = pattern.len();
        let mut starts: Vec<u32> = Vec::with_capacity(n + 1);
        starts.push(0);
        let half = pattern.columns.len() / 2;
        let (mut columns, mut lower) = (Vec::with_capacity(half), Vec::with_capacity(half));
        let mut inverse_pivots: Vec<E> = Vec::with_capacity(n);
        for i in 0..n {
            let begin = columns.len();
            let row = pattern.row(i);
            let below = pattern.columns[row.clone()].partition_point(|j| (*j as usize) < i);
            columns.extend(&pattern.columns[row.start..row.start + below]);
            lower.extend(&values.others[row.start..row.start + below]);
            let mut pivot = values.diagonal[i].times(raise);
            for k in begin..columns.len() {
                let j = columns[k] as usize;
                // Both rows ascend: merge them.
                let (mut a, mut b) = (begin, starts[j] as usize);
                let end = starts[j + 1] as usize;
                let mut entry: E = lower[k];
                while a < k && b < end {
                    let (ca, cb) = (columns[a], columns[b]);
                    if ca == cb {
                        let middle = &inverse_pivots[ca as usize];
                        entry = entry.plus(&lower[a].between(middle, &lower[b]).times(-1.0));
                    }
                    a += usize::from(ca <= cb);
                    b += usize::from(cb <= ca);
                }
                lower[k] = entry;
                pivot = pivot.plus(&entry.between(&inverse_pivots[j], &entry).times(-1.0));
            }
            inverse_pivots.push(pivot.inverted().ok_or(i)?);
            starts.push(columns.len() as u32);
        }
        Ok(Incomplete {
            starts,
            columns,
            lower,
            inverse_pivots,
        })
    }

    /// z = (P + Lᵀ)⁻¹ P (P + L)⁻¹ r.
    pub fn solve<const D: usize>(&self, r: &[Vect<D>], z: &mut [Vect<D>])
    where
        E: Entry<D>,
    {
        let row = |i: usize| self.starts[i] as usize..self.starts[i + 1] as usize;
        for i in 0..r.len() {
            let mut sum = r[i];
            for (l, &j) in self.lower[row(i)].iter().zip(&self.columns[row(i)]) {
                sum -= l.apply(&z[j as usize]);
            }
            z[i] = self.inverse_pivots[i].apply(&sum);
        }
        // Column by column from the end: z_j −= P_j⁻¹ l_ijᵀ z_i.
        for i in (0..r.len()).rev() {
            let own = z[i];
            for (l, &j) in self.lower[row(i)].iter().zip(&self.columns[row(i)]) {
                let j = j as usize;
                z[j] -= self.inverse_pivots[j].apply(&l.apply_transposed(&own));
            }
        }
    }
}
