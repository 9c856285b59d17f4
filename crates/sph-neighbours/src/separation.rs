//! Separations of the members of a cluster from one neighbour after the other, in lanes.

use sph_core::Vect;
use sph_lanes::{Body, Lane, dot};

use crate::Domain;
use crate::lane_vector::minus;
use crate::members::Members;

/// The places of some points, one in each lane; the last one fills what is left over.
#[inline(always)]
pub(crate) fn places<const D: usize, L: Lane>(points: &[Vect<D>]) -> [L; D] {
    let mut x = [L::splat(0.0); D];
    let last = points.len() - 1;
    for lane in 0..L::N {
        let point = &points[if lane < last { lane } else { last }];
        for k in 0..D {
            x[k].set(lane, point[k]);
        }
    }
    x
}

/// |r_i − r_j|² in all lanes.
#[inline(always)]
pub(crate) fn distance2_at<const D: usize, L: Lane>(x: &[L; D], there: &Vect<D>) -> L {
    let d = minus(x, there);
    dot(&d, &d)
}

/// Squared distances of the members of a cluster from all candidates, `N` numbers for each candidate.
///
/// A member is infinitely far from itself, so that the kernel leaves it out.
pub(crate) struct Distances<'a, const D: usize> {
    pub members: Members<'a>,
    pub positions: &'a [Vect<D>],
    /// Where images across periodic faces may be nearer.
    pub domain: Option<&'a Domain<D>>,
    pub out: &'a mut Vec<f64>,
}

impl<const D: usize> Body for Distances<'_, D> {
    type Output = ();

    #[inline(always)]
    fn call<L: Lane>(self) {
        let Members {
            from,
            count,
            candidates,
        } = self.members;
        let needed = candidates.len() * L::N;
        if self.out.len() < needed {
            self.out.resize(needed.next_power_of_two(), 0.0);
        }
        let out = &mut self.out[..needed];
        let own = &self.positions[from..from + count];
        let x = places::<D, L>(own);
        for (&j, out) in candidates.iter().zip(out.chunks_exact_mut(L::N)) {
            let mut apart = minus(&x, &self.positions[j as usize]);
            if let Some(domain) = self.domain {
                apart = domain.nearest_images(apart);
            }
            dot(&apart, &apart).store(out);
            let lane = (j as usize).wrapping_sub(from);
            if lane < count {
                out[lane] = f64::INFINITY;
            }
        }
    }
}
