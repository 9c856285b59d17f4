//! Sums over vectors of particles, in an order that does not depend on the number of threads.

use rayon::prelude::*;
use sph_core::Vect;

/// Members of one partial sum.
const PART: usize = 2048;
/// Partial sums that are made side by side.
const TOGETHER: usize = 64;

/// Σ x·y.
pub fn dot<const D: usize>(x: &[Vect<D>], y: &[Vect<D>]) -> f64 {
    let part =
        |(x, y): (&[Vect<D>], &[Vect<D>])| -> f64 { x.iter().zip(y).map(|(a, b)| a.dot(b)).sum() };
    let all = x.chunks(TOGETHER * PART).zip(y.chunks(TOGETHER * PART));
    let mut sum = 0.0;
    for (x, y) in all {
        let mut sums = [0.0; TOGETHER];
        let parts = x.par_chunks(PART).zip(y.par_chunks(PART));
        let count = parts.len();
        let parts = parts.zip(&mut sums);
        parts.for_each(|(both, sum)| *sum = part(both));
        sum = sums[..count].iter().fold(sum, |sum, part| sum + part);
    }
    sum
}

/// |x|.
pub fn norm<const D: usize>(x: &[Vect<D>]) -> f64 {
    dot(x, x).sqrt()
}

/// y += s x.
pub fn add<const D: usize>(y: &mut [Vect<D>], s: f64, x: &[Vect<D>]) {
    let pairs = y.par_iter_mut().zip(x).with_min_len(PART);
    pairs.for_each(|(y, x)| *y += x * s);
}

/// y = x + s y.
pub fn scale_and_add<const D: usize>(y: &mut [Vect<D>], s: f64, x: &[Vect<D>]) {
    let pairs = y.par_iter_mut().zip(x).with_min_len(PART);
    pairs.for_each(|(y, x)| *y = x + *y * s);
}
