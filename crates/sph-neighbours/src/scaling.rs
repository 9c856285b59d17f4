//! Walls that scale the kernel: w̃_ab = s_a s_b w_ab.

use sph_core::{Store, Vect, fields};
use sph_kernels::Sampler;
use sph_kernels::lanes::{Body, Lane, Width, dispatch_at};

use crate::members::Members;
use crate::particles::Particles;

/// Columns of walls that scale the kernel.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Scaling<'a, const D: usize> {
    /// s of every particle.
    pub scale: &'a [f64],
    /// ∇ ln s of every particle, 1/m; none for sums without walls.
    pub slope: Option<&'a [Vect<D>]>,
    pub kernel: &'a dyn Sampler,
}

impl<'a, const D: usize> Scaling<'a, D> {
    /// Of particles; none if their walls do not scale the kernel.
    pub fn of(free: &'a Store<D>, kernel: &'a dyn Sampler) -> Option<Self> {
        Some(Scaling {
            scale: free.get(fields::SCALE).ok()?,
            slope: Some(free.get(fields::SCALE_SLOPE).ok()?),
            kernel,
        })
    }

    /// Whether some of the pairs of a cluster are scaled.
    pub fn acts(&self, members: Members<'_>) -> bool {
        let mut candidates = members.candidates.iter();
        candidates.any(|j| self.scale[*j as usize] != 1.0)
    }

    /// Multiplies numbers of all pairs of a cluster, one per lane for each candidate, by s_a s_b.
    pub fn scale_pairs(&self, width: Width, members: Members<'_>, numbers: &mut [f64]) {
        let body = ScaledPairs {
            members,
            scale: self.scale,
            numbers,
        };
        dispatch_at(width, body);
    }

    /// At a particle.
    #[inline(always)]
    pub fn at(&self, particle: usize) -> WallScale<'a, D> {
        WallScale {
            all: self.scale,
            own: self.scale[particle],
            slope: self.slope.map_or_else(Vect::zeros, |g| g[particle]),
            kernel: self.kernel,
        }
    }
}

/// s and ∇ ln s at a particle.
#[derive(Clone, Copy, Debug)]
pub struct WallScale<'a, const D: usize> {
    pub(crate) all: &'a [f64],
    /// s of the particle.
    pub own: f64,
    /// ∇ ln s of the particle, 1/m; that of one wall in sums for this wall.
    pub slope: Vect<D>,
    pub(crate) kernel: &'a dyn Sampler,
}

impl<const D: usize> WallScale<'_, D> {
    /// The same for sums without walls.
    pub(crate) fn without_slope(self) -> Self {
        self.with_slope(Vect::zeros())
    }

    /// The same for sums with one wall, which has this part of the slope.
    pub(crate) fn with_slope(self, slope: Vect<D>) -> Self {
        WallScale { slope, ..self }
    }

    /// w̃_aa = s_a² w(0), 1/m^d: what a particle adds to its own sum.
    #[inline(always)]
    pub fn own_value(&self) -> f64 {
        self.own * self.own * self.kernel.value_at_zero()
    }

    /// s_a s_b.
    #[inline(always)]
    pub(crate) fn with(&self, other: usize) -> f64 {
        self.own * self.all[other]
    }

    /// s_a s_b w_ab at a squared distance, 1/m^d.
    pub(crate) fn value(&self, other: usize, distance2: f64) -> f64 {
        self.with(other) * self.kernel.at(distance2.sqrt()).0
    }
}

/// [`Scaling::scale_pairs`] with lanes.
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
