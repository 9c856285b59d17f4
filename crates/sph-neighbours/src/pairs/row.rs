//! The neighbourhood of one particle: geometry and kernel values as slices, computed once.

use sph_core::Vect;
use sph_kernels::Sampler;

use crate::{ContactRow, Domain, HiddenPairs, Scaling, WallScale};

/// Pairs of one particle with one set of sources, inside the support only.
#[derive(Clone, Copy, Debug, Default)]
pub struct Row<'a, const D: usize> {
    /// Indices of the neighbours.
    pub index: &'a [u32],
    /// Separations r_i − r_j, m.
    pub separation: &'a [Vect<D>],
    /// Squared distances, m².
    pub distance2: &'a [f64],
    /// F = w'(r)/r, so that ∇w = F (r_i − r_j), m^−(d+2).
    pub factor: &'a [f64],
}

/// Everything a term may sum over for one particle.
#[derive(Clone, Copy, Debug)]
pub struct Neighbourhood<'a, const D: usize> {
    /// Index of the particle.
    pub particle: usize,
    /// Its free neighbours.
    pub free: Row<'a, D>,
    /// Its wall points.
    pub wall: Row<'a, D>,
    /// Its wall elements with their share of ∇γ.
    pub contacts: ContactRow<'a, D>,
    /// 1/γ, 1 away from walls.
    pub inverse_renormalisation: f64,
    /// Scaling of the kernel by walls.
    pub scaling: Option<&'a Scaling<'a, D>>,
}

impl<'a, const D: usize> Neighbourhood<'a, D> {
    /// Values of the particle near walls that scale the kernel.
    #[inline(always)]
    pub fn scale(&self) -> Option<WallScale<D>> {
        self.scaling.map(|scaling| scaling.at(self.particle))
    }

    /// As a sum with s_a s_b w_ab sees it: γ = 1, without wall elements.
    #[inline(always)]
    pub(crate) fn scaled(&self) -> Neighbourhood<'a, D> {
        Neighbourhood {
            contacts: ContactRow::NONE,
            inverse_renormalisation: 1.0,
            ..*self
        }
    }
}

/// No index of any source.
pub const NOBODY: u32 = u32::MAX;

/// Buffers for one row; one per thread.
#[derive(Clone, Debug, Default)]
pub struct Scratch<const D: usize> {
    index: Vec<u32>,
    separation: Vec<Vect<D>>,
    distance2: Vec<f64>,
    factor: Vec<f64>,
    len: usize,
}

impl<const D: usize> Scratch<D> {
    /// Keeps the candidates within the support and evaluates F for them.
    ///
    /// `own` is left out: the target's index where it is one of the sources, else [`NOBODY`].
    #[inline]
    pub fn fill<K: Sampler + ?Sized>(
        &mut self,
        x: &Vect<D>,
        sources: &[Vect<D>],
        candidates: &[u32],
        own: u32,
        domain: Option<&Domain<D>>,
        kernel: &K,
    ) {
        let radius = kernel.support_radius();
        let limit = radius * radius;
        self.make_room(candidates.len());
        self.len = match domain {
            None => self.compress(x, sources, candidates, own, limit, |d| d),
            Some(domain) => self.compress(x, sources, candidates, own, limit, |d| {
                domain.nearest_image(d)
            }),
        };
        let n = self.len;
        kernel.gradient_factor(&self.distance2[..n], &mut self.factor[..n]);
    }

    #[inline(always)]
    fn compress(
        &mut self,
        x: &Vect<D>,
        sources: &[Vect<D>],
        candidates: &[u32],
        own: u32,
        limit: f64,
        image: impl Fn(Vect<D>) -> Vect<D>,
    ) -> usize {
        let m = candidates.len();
        let index = &mut self.index[..m];
        let separation = &mut self.separation[..m];
        let distance2 = &mut self.distance2[..m];
        let mut n = 0;
        for &j in candidates {
            let d = image(x - sources[j as usize]);
            let r2 = d.norm_squared();
            index[n] = j;
            separation[n] = d;
            distance2[n] = r2;
            n += usize::from((r2 < limit) & (j != own));
        }
        n
    }

    /// Keeps the candidates of one lane that are nearer than √`limit`; `[r, r², F]` of all of them stand in lanes.
    pub(crate) fn pick(
        &mut self,
        candidates: &[u32],
        [separations, distances, factors]: [&[f64]; 3],
        [lane, lanes]: [usize; 2],
        limit: f64,
    ) {
        self.make_room(candidates.len());
        let m = candidates.len();
        let index = &mut self.index[..m];
        let separation = &mut self.separation[..m];
        let distance2 = &mut self.distance2[..m];
        let factor = &mut self.factor[..m];
        let mut n = 0;
        let in_lanes = distances
            .chunks_exact(lanes)
            .zip(factors.chunks_exact(lanes))
            .zip(separations.chunks_exact(D * lanes));
        for (&j, ((r2, f), d)) in candidates.iter().zip(in_lanes) {
            index[n] = j;
            separation[n] = Vect::from_fn(|k, _| d[k * lanes + lane]);
            distance2[n] = r2[lane];
            factor[n] = f[lane];
            n += usize::from(r2[lane] < limit);
        }
        self.len = n;
    }

    fn make_room(&mut self, candidates: usize) {
        if self.index.len() < candidates {
            let n = candidates.next_power_of_two();
            self.index.resize(n, 0);
            self.separation.resize(n, Vect::zeros());
            self.distance2.resize(n, 0.0);
            self.factor.resize(n, 0.0);
        }
    }

    /// The row that was filled last.
    #[inline(always)]
    pub fn row(&self) -> Row<'_, D> {
        Row {
            index: &self.index[..self.len],
            separation: &self.separation[..self.len],
            distance2: &self.distance2[..self.len],
            factor: &self.factor[..self.len],
        }
    }

    pub(crate) fn copied(row: &Row<'_, D>, counts: impl Fn(u32) -> bool) -> Self {
        let mut kept = Scratch::default();
        for k in (0..row.index.len()).filter(|k| counts(row.index[*k])) {
            kept.index.push(row.index[k]);
            kept.separation.push(row.separation[k]);
            kept.distance2.push(row.distance2[k]);
            kept.factor.push(row.factor[k]);
            kept.len += 1;
        }
        kept
    }

    #[inline(always)]
    pub(crate) fn hide(&mut self, hidden: &HiddenPairs, particle: usize) {
        if hidden.is_empty() {
            return;
        }
        let mut n = 0;
        for k in 0..self.len {
            self.index[n] = self.index[k];
            self.separation[n] = self.separation[k];
            self.distance2[n] = self.distance2[k];
            self.factor[n] = self.factor[k];
            n += usize::from(!hidden.has(particle, self.index[k]));
        }
        self.len = n;
    }

    /// Clears the row.
    #[inline(always)]
    pub fn clear(&mut self) {
        self.len = 0;
    }
}

/// Buffers for the rows of free neighbours and wall points.
#[derive(Default)]
pub struct Rows<const D: usize> {
    pub(crate) free: Scratch<D>,
    pub(crate) wall: Scratch<D>,
}
