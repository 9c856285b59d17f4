//! Numbers, vectors and tuples of several particles side by side.

use crate::lanes::{Lane, MOST};

/// A number, a vector, a matrix or a tuple of these, one in each lane.
///
/// Single lanes are read from memory in which each number has a row: lanes that are taken apart in registers are taken
/// apart by the compiler in the loop before, too.
pub trait InLanes<L>: Copy {
    /// The same of one particle.
    type One: Copy;
    /// Count of its numbers.
    const NUMBERS: usize;
    /// Zero in all lanes.
    fn zero() -> Self;
    /// Leaves the numbers in the first [`NUMBERS`](Self::NUMBERS) rows.
    ///
    /// # Panics
    /// If there are fewer rows.
    fn store(&self, rows: &mut [[f64; MOST]]);
    /// Value in a column of the rows.
    ///
    /// # Panics
    /// If there are fewer rows.
    fn one(rows: &[[f64; MOST]], lane: usize) -> Self::One;
}

impl<L: Lane> InLanes<L> for L {
    type One = f64;
    const NUMBERS: usize = 1;
    #[inline(always)]
    fn zero() -> L {
        L::splat(0.0)
    }
    #[inline(always)]
    fn store(&self, rows: &mut [[f64; MOST]]) {
        Lane::store(*self, &mut rows[0]);
    }
    #[inline(always)]
    fn one(rows: &[[f64; MOST]], lane: usize) -> f64 {
        rows[0][lane]
    }
}

impl<L: Lane, T: InLanes<L>, const N: usize> InLanes<L> for [T; N] {
    type One = [T::One; N];
    const NUMBERS: usize = N * T::NUMBERS;
    #[inline(always)]
    fn zero() -> Self {
        [T::zero(); N]
    }
    #[inline(always)]
    fn store(&self, rows: &mut [[f64; MOST]]) {
        for k in 0..N {
            self[k].store(&mut rows[k * T::NUMBERS..]);
        }
    }
    #[inline(always)]
    fn one(rows: &[[f64; MOST]], lane: usize) -> Self::One {
        std::array::from_fn(|k| T::one(&rows[k * T::NUMBERS..], lane))
    }
}

macro_rules! tuples {
    ($(($($t:ident $k:tt),+))+) => {$(
        impl<L: Lane, $($t: InLanes<L>),+> InLanes<L> for ($($t,)+) {
            type One = ($($t::One,)+);
            const NUMBERS: usize = 0 $(+ $t::NUMBERS)+;
            #[inline(always)]
            fn zero() -> Self {
                ($($t::zero(),)+)
            }
            #[inline(always)]
            fn store(&self, rows: &mut [[f64; MOST]]) {
                let mut from = 0;
                $(
                    self.$k.store(&mut rows[from..]);
                    from += $t::NUMBERS;
                )+
                let _ = from;
            }
            #[inline(always)]
            fn one(rows: &[[f64; MOST]], lane: usize) -> Self::One {
                let mut from = 0;
                ($(
                    {
                        let own = $t::one(&rows[from..], lane);
                        from += $t::NUMBERS;
                        let _ = from;
                        own
                    },
                )+)
            }
        }
    )+};
}
tuples!((A 0, B 1) (A 0, B 1, C 2) (A 0, B 1, C 2, E 3));
