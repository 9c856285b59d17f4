//! The neighbourhood of a few particles at once.

use std::ops::Range;

use sph_core::Vect;
use sph_kernels::Sampler;
use sph_kernels::lanes::{Lane, MOST, Width, dispatch_at};

use crate::lanes::separation::Distances;
use crate::lists::{buffer::grow, members::Members};
use crate::{
    ContactRow, Contacts, Domain, HiddenPairs, LanePair, Neighbourhood, Row, Scaling, Scratch,
};

/// A few particles that follow each other, with distances and kernel gradients for all possible neighbours.
pub struct Cluster<'a, const D: usize> {
    pub(crate) width: Width,
    pub(crate) members: Members<'a>,
    pub(crate) contacts: &'a Contacts<D>,
    pub(crate) inverse_renormalisation: [f64; MOST],
    /// Square of the support radius, m².
    pub(crate) limit: f64,
    pub(crate) scaling: Option<&'a Scaling<'a, D>>,
    /// True if some of its pairs are scaled.
    pub(crate) scaled: bool,
    /// True if a wall is within reach of any member.
    pub(crate) beside: bool,
    pub(crate) wraps: bool,
    pub(crate) buffers: &'a mut Buffers<D>,
}

/// Memory kept from cluster to cluster; one per thread.
#[derive(Default)]
pub(crate) struct Buffers<const D: usize> {
    /// Squared distances, one number per lane for each candidate; infinite for a particle and itself.
    pub distance2: Vec<f64>,
    /// r_i − r_j, component by component for each candidate.
    pub separation: Vec<f64>,
    /// F in the order of the distances.
    pub factor: Vec<f64>,
    /// w in the same order, where it was requested.
    pub value: Vec<f64>,
    /// s_a s_b F and s_a s_b w in the same order, where walls scale some pair.
    pub scaled: [Vec<f64>; 2],
    /// Rows of wall points, one per member.
    pub walls: [Scratch<D>; MOST],
    /// Rows of free neighbours, one per member, where rows were requested.
    free: [Scratch<D>; MOST],
    pub sums: crate::lanes::particles::Rows,
    /// Marks of candidates that some member has within its support.
    pub inside: Vec<bool>,
    /// True if `free` is of the cluster at hand.
    rows: bool,
}

impl<const D: usize> Buffers<D> {
    /// Distances of the members of a cluster, and separations if they are `KEPT`; returns the number of distances.
    pub fn find<const KEPT: bool>(
        &mut self,
        width: Width,
        members: Members<'_>,
        positions: &[Vect<D>],
        domain: Option<&Domain<D>>,
        hidden: &HiddenPairs,
    ) -> usize {
        let distances = Distances::<D, KEPT> {
            members,
            positions,
            domain,
            out: &mut self.distance2,
            separations: &mut self.separation,
        };
        dispatch_at(width, distances);
        hidden.part(members, width.lanes(), &mut self.distance2);
        members.candidates.len() * width.lanes()
    }

    /// Leaves w, 1/m^d, for the first distances; 0 beyond the support and for a particle and itself.
    pub fn weigh<K: Sampler + ?Sized>(&mut self, distances: usize, kernel: &K) {
        grow(&mut self.value, distances);
        kernel.value(&self.distance2[..distances], &mut self.value[..distances]);
    }

    /// Distances and kernel gradients of the members of a cluster.
    pub fn measure<K: Sampler + ?Sized>(
        &mut self,
        width: Width,
        members: Members<'_>,
        positions: &[Vect<D>],
        domain: Option<&Domain<D>>,
        hidden: &HiddenPairs,
        kernel: &K,
    ) {
        let needed = self.find::<true>(width, members, positions, domain, hidden);
        grow(&mut self.factor, needed);
        kernel.gradient_factor(&self.distance2[..needed], &mut self.factor[..needed]);
        self.rows = false;
    }

    /// The numbers of pairs that walls scale.
    pub fn scale<const N: usize>(
        &mut self,
        width: Width,
        members: Members<'_>,
        scaling: &Scaling<'_, N>,
    ) {
        let needed = members.candidates.len() * width.lanes();
        let [factors, values] = &mut self.scaled;
        for numbers in [&mut *factors, &mut *values] {
            grow(numbers, needed);
        }
        let (factors, values) = (&mut factors[..needed], &mut values[..needed]);
        factors.copy_from_slice(&self.factor[..needed]);
        scaling.kernel.value(&self.distance2[..needed], values);
        for numbers in [factors, values] {
            scaling.scale_pairs(width, members, numbers);
        }
    }
}

impl<const D: usize> Cluster<'_, D> {
    /// Its particles, which follow each other.
    #[inline(always)]
    pub fn members(&self) -> Range<usize> {
        self.members.range()
    }

    /// Possible neighbours of any of them, in index order, the particles themselves among them.
    #[inline(always)]
    pub fn candidates(&self) -> &[u32] {
        self.members.candidates
    }

    /// Number of lanes, at least as many as there are members.
    #[inline(always)]
    pub fn lanes(&self) -> usize {
        self.width.lanes()
    }

    /// Calls `visit` with the number and the neighbourhood of every member, one after the other.
    pub fn rows(&mut self, mut visit: impl FnMut(usize, &Neighbourhood<'_, D>)) {
        if !self.buffers.rows {
            self.fill_rows();
        }
        for k in 0..self.members.count {
            let neighbourhood = Neighbourhood {
                free: self.buffers.free[k].row(),
                ..self.walls(k)
            };
            visit(k, &neighbourhood);
        }
    }

    /// r_i − r_j of all members from a candidate by its place, m.
    #[inline(always)]
    pub(crate) fn separation<L: Lane>(&self, candidate: usize) -> [L; D] {
        let from = D * candidate * L::N;
        let apart = &self.buffers.separation[from..from + D * L::N];
        let mut separation = [L::splat(0.0); D];
        for k in 0..D {
            separation[k] = L::load(&apart[k * L::N..]);
        }
        separation
    }

    /// A candidate by its place as all members see it, without kernel values.
    #[inline(always)]
    pub(crate) fn pair<L: Lane>(&self, candidate: usize) -> LanePair<D, L> {
        let from = candidate * L::N;
        LanePair {
            separation: self.separation(candidate),
            distance2: L::load(&self.buffers.distance2[from..from + L::N]),
            factor: L::load(&self.buffers.factor[from..from + L::N]),
            value: L::splat(0.0),
        }
    }

    /// The walls of a member; its row of free neighbours is empty.
    #[inline(always)]
    pub fn walls(&self, member: usize) -> Neighbourhood<'_, D> {
        let particle = self.members.from + member;
        // Most clusters are away from walls.
        let (walls, contacts) = (&self.buffers.walls, self.contacts);
        let (wall, contacts) = match self.beside {
            true => (walls[member].row(), contacts.of_particle(particle)),
            false => (Row::default(), ContactRow::NONE),
        };
        Neighbourhood {
            particle,
            free: Row::default(),
            wall,
            contacts,
            inverse_renormalisation: self.inverse_renormalisation[member],
            scaling: self.scaling,
        }
    }

    fn fill_rows(&mut self) {
        let lanes = self.width.lanes();
        let candidates = self.members.candidates;
        let buffers = &mut *self.buffers;
        let measures = [&buffers.separation[..], &buffers.distance2, &buffers.factor];
        for (k, row) in buffers.free.iter_mut().enumerate().take(self.members.count) {
            row.pick(candidates, measures, [k, lanes], self.limit);
        }
        buffers.rows = true;
    }
}
