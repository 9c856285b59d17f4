//! The neighbourhood of a few particles at once.

use std::ops::Range;

use sph_core::Vect;
use sph_kernels::Sampler;
use sph_lanes::{Lane, MOST, Width, dispatch_at};

use crate::lane_pair::LanePair;
use crate::lane_vector::minus;
use crate::members::Members;
use crate::separation::Distances;
use crate::{Blocked, Contacts, Domain, Neighbourhood, Row, Scratch, There};

/// A few particles that follow each other, with distances and kernel gradients for all whom they may have as neighbours.
pub struct Cluster<'a, const D: usize> {
    pub(crate) width: Width,
    pub(crate) members: Members<'a>,
    pub(crate) positions: &'a [Vect<D>],
    pub(crate) states: &'a [There<D>],
    pub(crate) contacts: &'a Contacts<D>,
    pub(crate) renormalisation: Option<&'a [f64]>,
    /// Square of the support radius, m².
    pub(crate) limit: f64,
    /// Where images across periodic faces may be nearer.
    pub(crate) domain: Option<&'a Domain<D>>,
    pub(crate) buffers: &'a mut Buffers<D>,
}

/// What is kept from cluster to cluster; one per thread.
pub(crate) struct Buffers<const D: usize> {
    /// Squared distances, one number per lane for each candidate; infinite for a particle and itself.
    pub distance2: Vec<f64>,
    /// F in the same order.
    pub factor: Vec<f64>,
    /// w in the same order, where somebody asked for it.
    pub value: Vec<f64>,
    /// Rows of wall points, one per member.
    pub walls: [Scratch<D>; MOST],
    /// Rows of free neighbours, one per member, where somebody asked for rows.
    free: [Scratch<D>; MOST],
    /// Whether `free` is of the cluster at hand.
    rows: bool,
}

impl<const D: usize> Default for Buffers<D> {
    fn default() -> Self {
        Buffers {
            distance2: Vec::new(),
            factor: Vec::new(),
            value: Vec::new(),
            walls: std::array::from_fn(|_| Scratch::new()),
            free: std::array::from_fn(|_| Scratch::new()),
            rows: false,
        }
    }
}

impl<const D: usize> Buffers<D> {
    /// Distances and kernel gradients of the members of a cluster.
    pub fn measure<K: Sampler + ?Sized>(
        &mut self,
        width: Width,
        members: Members<'_>,
        positions: &[Vect<D>],
        domain: Option<&Domain<D>>,
        hidden: &Blocked,
        kernel: &K,
    ) {
        let out = &mut self.distance2;
        dispatch_at(
            width,
            Distances {
                members,
                positions,
                domain,
                out,
            },
        );
        hidden.part(members, width.lanes(), &mut self.distance2);
        let needed = members.candidates.len() * width.lanes();
        if self.factor.len() < needed {
            self.factor.resize(needed.next_power_of_two(), 0.0);
        }
        kernel.gradient_factor(&self.distance2[..needed], &mut self.factor[..needed]);
        self.rows = false;
    }
}

impl<const D: usize> Cluster<'_, D> {
    /// Its particles, which follow each other.
    #[inline(always)]
    pub fn members(&self) -> Range<usize> {
        self.members.from..self.members.from + self.members.count
    }

    /// Whom any of them may have as a neighbour, in index order, the particles themselves among them.
    #[inline(always)]
    pub fn candidates(&self) -> &[u32] {
        self.members.candidates
    }

    /// Number of lanes, at least as many as there are members.
    #[inline(always)]
    pub fn lanes(&self) -> usize {
        self.width.lanes()
    }

    /// Squared distances, m², one number per lane for each candidate; infinite for a particle and itself.
    #[inline(always)]
    pub fn distance2(&self) -> &[f64] {
        &self.buffers.distance2[..self.members.candidates.len() * self.lanes()]
    }

    /// F, 1/m^(d+2), in the same order; 0 beyond the support.
    #[inline(always)]
    pub fn factor(&self) -> &[f64] {
        &self.buffers.factor[..self.members.candidates.len() * self.lanes()]
    }

    /// Leaves w, 1/m^d, in the same order in a buffer; 0 beyond the support and for a particle and itself.
    pub(crate) fn weigh<K: Sampler + ?Sized>(&mut self, kernel: &K) {
        let needed = self.members.candidates.len() * self.lanes();
        let Buffers {
            distance2, value, ..
        } = &mut *self.buffers;
        if value.len() < needed {
            value.resize(needed.next_power_of_two(), 0.0);
        }
        kernel.value(&distance2[..needed], &mut value[..needed]);
    }

    /// r_i − r_j, m.
    #[inline(always)]
    pub fn separation(&self, particle: usize, neighbour: usize) -> Vect<D> {
        let apart = self.positions[particle] - self.positions[neighbour];
        match self.domain {
            Some(domain) => domain.nearest_image(apart),
            None => apart,
        }
    }

    /// Calls `visit` with the number and the neighbourhood of every member, one after the other.
    pub fn rows(&mut self, mut visit: impl FnMut(usize, &Neighbourhood<'_, D>)) {
        if !self.buffers.rows {
            self.fill_rows();
        }
        for k in 0..self.members.count {
            let particle = self.members.from + k;
            let neighbourhood = Neighbourhood {
                particle,
                free: self.buffers.free[k].row(),
                states: self.states,
                wall: self.buffers.walls[k].row(),
                contacts: self.contacts.of(particle),
                inverse_renormalisation: self.renormalisation.map_or(1.0, |g| 1.0 / g[particle]),
            };
            visit(k, &neighbourhood);
        }
    }

    /// One neighbour of all members, who stand at `x`; `distance2` and `factor` are the neighbour's in the buffers.
    #[inline(always)]
    pub(crate) fn pair<L: Lane>(
        &self,
        x: &[L; D],
        neighbour: usize,
        distance2: &[f64],
        factor: &[f64],
    ) -> LanePair<D, L> {
        let mut separation = minus(x, &self.positions[neighbour]);
        if let Some(domain) = self.domain {
            separation = domain.nearest_images(separation);
        }
        LanePair {
            separation,
            distance2: L::load(distance2),
            factor: L::load(factor),
        }
    }

    /// The walls of a member; its row of free neighbours is empty.
    pub fn walls(&self, member: usize) -> Neighbourhood<'_, D> {
        let particle = self.members.from + member;
        Neighbourhood {
            particle,
            free: Row::empty(),
            states: self.states,
            wall: self.buffers.walls[member].row(),
            contacts: self.contacts.of(particle),
            inverse_renormalisation: self.renormalisation.map_or(1.0, |g| 1.0 / g[particle]),
        }
    }

    fn fill_rows(&mut self) {
        let lanes = self.width.lanes();
        let Buffers {
            distance2,
            factor,
            free,
            rows,
            ..
        } = &mut *self.buffers;
        for (k, row) in free.iter_mut().enumerate().take(self.members.count) {
            let x = &self.positions[self.members.from + k];
            row.pick(
                x,
                self.positions,
                self.members.candidates,
                [distance2, factor],
                [k, lanes],
                self.limit,
                self.domain,
            );
        }
        *rows = true;
    }
}
