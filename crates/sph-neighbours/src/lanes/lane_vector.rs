//! Vectors whose components stand in lanes.

use sph_core::Vect;
use sph_kernels::lanes::Lane;

/// The same vector in all lanes.
#[inline(always)]
pub fn splat<const D: usize, L: Lane>(v: &Vect<D>) -> [L; D] {
    let mut lanes = [L::splat(0.0); D];
    for k in 0..D {
        lanes[k] = L::splat(v[k]);
    }
    lanes
}

/// The vector in a lane.
#[inline(always)]
pub fn vector<const D: usize, L: Lane>(lanes: &[L; D], lane: usize) -> Vect<D> {
    let mut v = Vect::zeros();
    for k in 0..D {
        v[k] = lanes[k].at(lane);
    }
    v
}

/// Positive where the phases are not `other`: they are small whole numbers, exact as any.
#[inline(always)]
pub fn unlike<L: Lane>(phases: L, other: u32) -> L {
    let apart = phases - L::splat(f64::from(other));
    apart * apart
}

/// a − b, b being the same in all lanes.
#[inline(always)]
pub fn minus<const D: usize, L: Lane>(a: &[L; D], b: &Vect<D>) -> [L; D] {
    let mut difference = *a;
    for k in 0..D {
        difference[k] -= L::splat(b[k]);
    }
    difference
}
