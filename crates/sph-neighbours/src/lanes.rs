//! Particles, places and pairs in lanes.

pub(crate) mod particles;
pub(crate) mod separation;

use nalgebra::SMatrix;
use sph_core::Vect;
use sph_kernels::lanes::{Lane, dot};

/// One pair of a particle.
#[derive(Clone, Copy, Debug)]
pub struct Pair<const D: usize> {
    /// r_i − r_j, m.
    pub separation: Vect<D>,
    /// |r_i − r_j|², m².
    pub distance2: f64,
    /// F = w'(r)/r ≤ 0: ∇w = F · separation.
    pub factor: f64,
}

/// One neighbour as the particles of a cluster see it, a particle in each lane.
#[derive(Clone, Copy, Debug)]
pub struct LanePair<const D: usize, L> {
    /// r_i − r_j, m.
    pub separation: [L; D],
    /// |r_i − r_j|², m²; infinite for a particle and itself.
    pub distance2: L,
    /// F = w'(r)/r ≤ 0, 1/m^(d+2); 0 where the neighbour is beyond the support, and for itself.
    pub factor: L,
    /// w, 1/m^d, where a sum asks for it ([`PairSum::VALUES`](crate::PairSum::VALUES)), else 0; 0 beyond the support.
    pub value: L,
}

impl<const D: usize> From<&Pair<D>> for LanePair<D, f64> {
    #[inline(always)]
    fn from(pair: &Pair<D>) -> Self {
        LanePair {
            separation: pair.separation.data.0[0],
            distance2: pair.distance2,
            factor: pair.factor,
            value: 0.0,
        }
    }
}

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

/// u_ab − ½(G_a + G_b) r_ab: the part of a difference of velocities that no linear field explains; b is the same in all
/// lanes.
#[inline(always)]
pub fn beyond_linear<const D: usize, L: Lane>(
    (velocity, gradient): (&[L; D], &[[L; D]; D]),
    (other, slope): (&Vect<D>, &SMatrix<f64, D, D>),
    separation: &[L; D],
) -> [L; D] {
    std::array::from_fn(|k| {
        let mut row = gradient[k];
        for (l, entry) in row.iter_mut().enumerate() {
            *entry = (*entry + L::splat(slope[(k, l)])) * L::splat(0.5);
        }
        velocity[k] - L::splat(other[k]) - dot(&row, separation)
    })
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
