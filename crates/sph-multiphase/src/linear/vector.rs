//! Arithmetic of vectors of particles.

use rayon::prelude::*;
use sph_core::Vect;
use sph_neighbours::inner;

/// Rows that one thread takes at least.
const PART: usize = 2048;

/// |x|.
pub fn norm<const D: usize>(x: &[Vect<D>]) -> f64 {
    inner(x, x).sqrt()
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
