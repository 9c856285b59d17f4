//! Numbers of a formula: one, or several side by side.

use std::fmt::Debug;
use std::ops::{Add, AddAssign, Div, Mul, Neg, Sub, SubAssign};

/// Numbers side by side; `f64` is one. Every operation works lane by lane, rounded as `f64` is.
pub trait Lane:
    Copy
    + Debug
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
    + AddAssign
    + SubAssign
    + 'static
{
    /// Number of lanes.
    const N: usize;
    /// The same number in every lane.
    fn splat(x: f64) -> Self;
    /// The number in a lane.
    fn at(&self, lane: usize) -> f64;
    /// Puts a number into a lane.
    fn set(&mut self, lane: usize, x: f64);
    /// The first `N` numbers of a slice.
    ///
    /// # Panics
    /// If the slice is shorter.
    fn load(from: &[f64]) -> Self;
    /// Leaves the numbers in the first `N` places of a slice.
    ///
    /// # Panics
    /// If the slice is shorter.
    fn store(self, to: &mut [f64]);
    /// Square root.
    fn sqrt(self) -> Self;
    /// Absolute value.
    fn abs(self) -> Self;
    /// The larger of the two, as [`f64::max`].
    fn max(self, other: Self) -> Self;
    /// `yes` where `self` > 0, else `no`; of NaN, `no`.
    fn where_positive(self, yes: Self, no: Self) -> Self;
    /// True if any lane is less than that of `other`.
    fn any_less(self, other: Self) -> bool;
    /// True if any lane is not 0; NaN is not.
    fn any_nonzero(self) -> bool;
    /// m from 1/√2 to √2 and the whole number e of x = m 2ᵉ, for normal positive numbers.
    fn parts(self) -> (Self, Self);
}

/// The bits of 1/√2, without the lower half of its digits.
const ROOT_HALF: u64 = 0x3fe6_a09e_0000_0000;
/// The bits of 1.5 · 2⁵², to which a small whole number is added as such.
const WHOLE: u64 = 0x4338_0000_0000_0000;

/// [`Lane::parts`] of one number.
#[inline(always)]
pub(crate) fn parts(x: f64) -> (f64, f64) {
    let above = x.to_bits().wrapping_sub(ROOT_HALF);
    let exponent = (above as i64 >> 52) as u64;
    let mantissa = x.to_bits().wrapping_sub(exponent << 52);
    let whole = f64::from_bits(WHOLE.wrapping_add(exponent)) - f64::from_bits(WHOLE);
    (f64::from_bits(mantissa), whole)
}

impl Lane for f64 {
    const N: usize = 1;
    #[inline(always)]
    fn splat(x: f64) -> f64 {
        x
    }
    #[inline(always)]
    fn at(&self, _lane: usize) -> f64 {
        *self
    }
    #[inline(always)]
    fn set(&mut self, _lane: usize, x: f64) {
        *self = x;
    }
    #[inline(always)]
    fn load(from: &[f64]) -> f64 {
        from[0]
    }
    #[inline(always)]
    fn store(self, to: &mut [f64]) {
        to[0] = self;
    }
    #[inline(always)]
    fn sqrt(self) -> f64 {
        f64::sqrt(self)
    }
    #[inline(always)]
    fn abs(self) -> f64 {
        f64::abs(self)
    }
    #[inline(always)]
    fn max(self, other: f64) -> f64 {
        f64::max(self, other)
    }
    #[inline(always)]
    fn where_positive(self, yes: f64, no: f64) -> f64 {
        if self > 0.0 { yes } else { no }
    }
    #[inline(always)]
    fn any_less(self, other: f64) -> bool {
        self < other
    }
    #[inline(always)]
    fn any_nonzero(self) -> bool {
        self != 0.0
    }
    #[inline(always)]
    fn parts(self) -> (f64, f64) {
        parts(self)
    }
}

/// a·b, summed from the first component on.
#[inline(always)]
pub fn dot<const D: usize, L: Lane>(a: &[L; D], b: &[L; D]) -> L {
    let mut sum = a[0] * b[0];
    for k in 1..D {
        sum += a[k] * b[k];
    }
    sum
}

/// v s.
#[inline(always)]
pub fn scaled<const D: usize, L: Lane>(mut v: [L; D], s: L) -> [L; D] {
    for component in &mut v {
        *component = *component * s;
    }
    v
}

/// sum + v s.
#[inline(always)]
pub fn add_scaled<const D: usize, L: Lane>(sum: &mut [L; D], v: &[L; D], s: L) {
    for k in 0..D {
        sum[k] += v[k] * s;
    }
}
