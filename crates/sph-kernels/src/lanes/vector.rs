//! Several numbers as an array, whose loops the compiler turns into vector instructions.

use std::ops::{Add, AddAssign, Div, Mul, Neg, Sub, SubAssign};

use crate::lanes::Lane;
use crate::lanes::lane::parts;

/// Most numbers side by side.
pub const MOST: usize = 8;

/// `N` numbers side by side.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(align(64))]
pub struct Lanes<const N: usize>([f64; N]);

macro_rules! binary {
    ($($trait:ident $f:ident $op:tt;)*) => {
        $(impl<const N: usize> $trait for Lanes<N> {
            type Output = Self;
            #[inline(always)]
            fn $f(mut self, other: Self) -> Self {
                for k in 0..N {
                    self.0[k] $op other.0[k];
                }
                self
            }
        })*
    };
}
binary! {
    Add add +=;
    Sub sub -=;
    Mul mul *=;
    Div div /=;
}

impl<const N: usize> Neg for Lanes<N> {
    type Output = Self;
    #[inline(always)]
    fn neg(mut self) -> Self {
        for k in 0..N {
            self.0[k] = -self.0[k];
        }
        self
    }
}

impl<const N: usize> AddAssign for Lanes<N> {
    #[inline(always)]
    fn add_assign(&mut self, other: Self) {
        *self = *self + other;
    }
}

impl<const N: usize> SubAssign for Lanes<N> {
    #[inline(always)]
    fn sub_assign(&mut self, other: Self) {
        *self = *self - other;
    }
}

impl<const N: usize> Lane for Lanes<N> {
    const N: usize = N;
    #[inline(always)]
    fn splat(x: f64) -> Self {
        Lanes([x; N])
    }
    #[inline(always)]
    fn at(&self, lane: usize) -> f64 {
        self.0[lane]
    }
    #[inline(always)]
    fn set(&mut self, lane: usize, x: f64) {
        self.0[lane] = x;
    }
    #[inline(always)]
    fn load(from: &[f64]) -> Self {
        // A copy of the slice would be a call where nothing is optimised across units.
        Lanes(*from.first_chunk().expect("as many numbers as lanes"))
    }
    #[inline(always)]
    fn store(self, to: &mut [f64]) {
        *to.first_chunk_mut().expect("as many places as lanes") = self.0;
    }
    #[inline(always)]
    fn sqrt(mut self) -> Self {
        for k in 0..N {
            self.0[k] = self.0[k].sqrt();
        }
        self
    }
    #[inline(always)]
    fn abs(mut self) -> Self {
        for k in 0..N {
            self.0[k] = self.0[k].abs();
        }
        self
    }
    #[inline(always)]
    fn max(mut self, other: Self) -> Self {
        for k in 0..N {
            self.0[k] = self.0[k].max(other.0[k]);
        }
        self
    }
    #[inline(always)]
    fn where_positive(self, yes: Self, mut no: Self) -> Self {
        for k in 0..N {
            no.0[k] = if self.0[k] > 0.0 { yes.0[k] } else { no.0[k] };
        }
        no
    }
    #[inline(always)]
    fn any_less(self, other: Self) -> bool {
        let mut any = false;
        for k in 0..N {
            any |= self.0[k] < other.0[k];
        }
        any
    }
    #[inline(always)]
    fn any_nonzero(self) -> bool {
        let mut any = false;
        for k in 0..N {
            any |= self.0[k] != 0.0;
        }
        any
    }
    #[inline(always)]
    fn parts(mut self) -> (Self, Self) {
        let mut exponents = self;
        for k in 0..N {
            (self.0[k], exponents.0[k]) = parts(self.0[k]);
        }
        (self, exponents)
    }
}
