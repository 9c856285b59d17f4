//! Sums over all particles of a flow, on all ranks.

use std::ops::Range;

use sph_core::StepError;

use crate::{World, joined};

/// Bits of the largest value in a sum: with as many as these, 2⁴⁶ values cannot overflow 128 bits.
const BITS: i32 = 80;
const LIMBS: usize = 4;
const BATCH: usize = 1024;

impl<const D: usize> World<D> {
    /// Sums over all particles, of those of other ranks, too: each value in whole numbers of 2⁻⁸⁰ of the largest one, so that the
    /// sum does not depend on the order, the threads, nor on the ranks of the particles.
    ///
    /// # Errors
    /// If another rank has failed, as everywhere below.
    pub fn sums<const N: usize>(
        &self,
        each: impl Fn(usize) -> [f64; N] + Sync,
    ) -> Result<[f64; N], StepError> {
        let owned = self.owned();
        self.sums_of(self.free.len(), &|i| owned.has(i).then(|| each(i)))
    }

    /// The same of `count` values, some of which may be missing; of several ranks each has some. Each is asked for twice.
    pub fn sums_of<const N: usize>(
        &self,
        count: usize,
        each: &(dyn Fn(usize) -> Option<[f64; N]> + Sync),
    ) -> Result<[f64; N], StepError> {
        let larger = |a: [f64; N], b: [f64; N]| std::array::from_fn(|k| a[k].max(b[k]));
        let largest_of = |range: Range<usize>| {
            let sizes = range.filter_map(each).map(|values| values.map(f64::abs));
            sizes.fold([0.0; N], larger)
        };
        let mut largest = joined(count, BATCH, [0.0; N], &largest_of, larger);
        self.largest(&mut largest)?;
        // Powers of two: scaling rounds nothing.
        let shifts = largest.map(|m| BITS - exponent(m));
        let powers = shifts.map(powers);
        let whole = |values: [f64; N]| {
            let scaled = |k: usize| values[k] * powers[k][0] * powers[k][1];
            std::array::from_fn(|k| scaled(k).round_ties_even() as i128)
        };
        let plus = |a: [i128; N], b: [i128; N]| std::array::from_fn(|k| a[k].wrapping_add(b[k]));
        let sum_of = |range: Range<usize>| range.filter_map(each).map(whole).fold([0; N], plus);
        let mut sums = joined(count, BATCH, [0; N], &sum_of, plus);
        self.total(&mut sums)?;
        Ok(std::array::from_fn(|k| scaled(sums[k] as f64, -shifts[k])))
    }

    /// The sums of parts by the number of their place, below `count`; of several ranks each has some. They depend neither on the
    /// order nor on the owners, as [`sums`](Self::sums).
    pub fn sums_by_place(
        &self,
        parts: &[(usize, f64)],
        count: usize,
    ) -> Result<Vec<f64>, StepError> {
        let mut largest = vec![0.0_f64; count];
        for (place, part) in parts {
            largest[*place] = largest[*place].max(part.abs());
        }
        self.largest(&mut largest)?;
        let shifts: Vec<i32> = largest.iter().map(|m| BITS - exponent(*m)).collect();
        let mut sums = vec![0_i128; count];
        for (place, part) in parts {
            let whole = scaled(*part, shifts[*place]).round_ties_even() as i128;
            sums[*place] = sums[*place].wrapping_add(whole);
        }
        self.total(&mut sums)?;
        let each = |(sum, shift): (&i128, i32)| scaled(*sum as f64, -shift);
        Ok(sums.iter().zip(shifts).map(each).collect())
    }

    fn total(&self, sums: &mut [i128]) -> Result<(), StepError> {
        let Some(link) = &self.communicator else {
            return Ok(());
        };
        let limb = |sum: i128, k: usize| (sum as u128 >> (32 * k)) as u64 & 0xFFFF_FFFF;
        let limbs = |sum: &i128| std::array::from_fn::<_, LIMBS, _>(|k| limb(*sum, k));
        let mut limbs: Vec<u64> = sums.iter().flat_map(limbs).collect();
        link.total(&mut limbs)?;
        for (sum, limbs) in sums.iter_mut().zip(limbs.chunks(LIMBS)) {
            let joined = |all: u128, (k, limb): (usize, &u64)| {
                all.wrapping_add(u128::from(*limb) << (32 * k))
            };
            *sum = limbs.iter().enumerate().fold(0, joined) as i128;
        }
        Ok(())
    }
}

/// Exponent of the power of two beyond a value; 0 for values that are zero, subnormal or not finite.
fn exponent(value: f64) -> i32 {
    match value.is_normal() {
        true => ((value.to_bits() >> 52) & 0x7FF) as i32 - 1022,
        false => 0,
    }
}

/// Two factors whose product is 2^shift, which itself may overflow.
fn powers(shift: i32) -> [f64; 2] {
    let half = shift / 2;
    [half, shift - half].map(|power| 2_f64.powi(power))
}

/// value · 2^shift.
fn scaled(value: f64, shift: i32) -> f64 {
    let [first, second] = powers(shift);
    value * first * second
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn scaling_is_exact_and_the_largest_value_has_all_its_bits() {
        for value in [1.0, 0.1, 3.7e200, 5.1e-200, 1.0 / 3.0] {
            let shift = BITS - exponent(value);
            let whole = scaled(value, shift);
            assert!(whole < 2_f64.powi(BITS) && whole >= 2_f64.powi(BITS - 1));
            assert_eq!(scaled(whole, -shift), value);
        }
        assert_eq!(exponent(0.0), 0);
    }
}
