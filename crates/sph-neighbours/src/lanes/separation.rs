//! Separations of the members of a cluster from one neighbour after the other, in lanes.

use sph_core::Vect;
use sph_kernels::lanes::{Body, Lane, dot};

use crate::lists::{buffer::grow, members::Members};
use crate::{Domain, Particles, minus};

/// The places of some points, one in each lane; the last one fills the rest.
#[inline(always)]
pub(crate) fn places<const D: usize, L: Lane>(points: &[Vect<D>]) -> [L; D] {
    Particles::first(points.len()).vectors(points)
}

/// Squared distances of the members of a cluster from all candidates, `N` numbers for each candidate; and separations, as
/// many for each component, where they are `KEPT`.
/// A member is infinitely far from itself, so that the kernel leaves it out.
pub(crate) struct Distances<'a, const D: usize, const KEPT: bool> {
    pub members: Members<'a>,
    pub positions: &'a [Vect<D>],
    /// The domain, where images across periodic faces may be nearer.
    pub domain: Option<&'a Domain<D>>,
    pub out: &'a mut Vec<f64>,
    pub separations: &'a mut Vec<f64>,
}

impl<const D: usize, const KEPT: bool> Body for Distances<'_, D, KEPT> {
    type Output = ();

    #[inline(always)]
    fn call<L: Lane>(self) {
        let members = self.members;
        let needed = members.candidates.len() * L::N;
        grow(self.out, needed);
        let out = &mut self.out[..needed];
        if KEPT {
            grow(self.separations, D * needed);
        }
        let mut kept = self.separations.chunks_exact_mut(D * L::N);
        let x = Particles::from(members).vectors::<D, L>(self.positions);
        for (&j, out) in members.candidates.iter().zip(out.chunks_exact_mut(L::N)) {
            let mut apart = minus(&x, &self.positions[j as usize]);
            if let Some(domain) = self.domain {
                apart = domain.nearest_images(apart);
            }
            if KEPT && let Some(kept) = kept.next() {
                for k in 0..D {
                    apart[k].store(&mut kept[k * L::N..]);
                }
            }
            dot(&apart, &apart).store(out);
            let lane = (j as usize).wrapping_sub(members.from);
            if lane < members.count {
                out[lane] = f64::INFINITY;
            }
        }
    }
}
