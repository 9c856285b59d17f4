//! Walls that scale the kernel: w̃_ab = s_a s_b w_ab.

use sph_core::{Store, Vect, fields};
use sph_kernels::Sampler;
use sph_kernels::lanes::{Body, Lane, Width, dispatch_at};

use crate::Particles;
use crate::lists::members::Members;

/// Columns of walls that scale the kernel.
#[derive(Clone, Copy, Debug)]
pub struct Scaling<'a, const D: usize> {
    scale: &'a [f64],
    slope: SlopeOf<'a, D>,
    pub(crate) kernel: &'a dyn Sampler,
}

/// ∇ ln s, 1/m.
#[derive(Clone, Copy, Debug)]
enum SlopeOf<'a, const D: usize> {
    /// Of all walls, at every particle.
    All(&'a [Vect<D>]),
    /// Of some walls, at the particle in hand.
    Some(Vect<D>),
}

impl<'a, const D: usize> Scaling<'a, D> {
    /// Of particles; none if their walls do not scale the kernel.
    pub(crate) fn from_store(free: &'a Store<D>, kernel: &'a dyn Sampler) -> Option<Self> {
        Some(Scaling {
            scale: free.get(fields::SCALE).ok()?,
            slope: SlopeOf::All(free.get(fields::SCALE_SLOPE).ok()?),
            kernel,
        })
    }

    /// True if some of the pairs of a cluster are scaled.
    pub(crate) fn acts(&self, members: Members<'_>) -> bool {
        let mut candidates = members.candidates.iter();
        candidates.any(|j| self.scale[*j as usize] != 1.0)
    }

    /// Multiplies numbers of all pairs of a cluster, one per lane for each candidate, by s_a s_b.
    pub(crate) fn scale_pairs(&self, width: Width, members: Members<'_>, numbers: &mut [f64]) {
        let body = ScaledPairs {
            members,
            scale: self.scale,
            numbers,
        };
        dispatch_at(width, body);
    }

    /// The same for sums with one wall, which has this part of the slope; 0 for those without walls.
    pub(crate) fn with_slope(&self, slope: Vect<D>) -> Self {
        Scaling {
            slope: SlopeOf::Some(slope),
            ..*self
        }
    }

    #[inline(always)]
    pub(crate) fn at(&self, particle: usize) -> WallScale<D> {
        let own = self.scale[particle];
        WallScale {
            own_value: own * own * self.kernel.value_at_zero(),
            slope: match self.slope {
                SlopeOf::All(all) => all[particle],
                SlopeOf::Some(slope) => slope,
            },
        }
    }

    pub(crate) fn of_pair(&self, first: usize, second: usize) -> f64 {
        self.scale[first] * self.scale[second]
    }
}

/// Values of a particle near walls that scale the kernel.
#[derive(Clone, Copy, Debug)]
pub struct WallScale<const D: usize> {
    /// w̃_aa = s_a² w(0), 1/m^d: the particle's part in its own sum.
    pub own_value: f64,
    /// ∇ ln s, 1/m; that of one wall in sums for this wall.
    pub slope: Vect<D>,
}

struct ScaledPairs<'a> {
    members: Members<'a>,
    scale: &'a [f64],
    numbers: &'a mut [f64],
}

impl Body for ScaledPairs<'_> {
    type Output = ();

    #[inline(always)]
    fn call<L: Lane>(self) {
        let own: L = Particles::from(self.members).numbers(self.scale);
        let lanes = self.numbers.chunks_exact_mut(L::N);
        for (&j, lanes) in self.members.candidates.iter().zip(lanes) {
            (L::load(lanes) * (own * L::splat(self.scale[j as usize]))).store(lanes);
        }
    }
}
