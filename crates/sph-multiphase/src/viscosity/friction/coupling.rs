//! The rows of a friction's matrix.

use sph_core::{Access, StepError, Vect};
use sph_neighbours::{
    Cluster, Kinds, Lane, LanePair, Neighbourhood, Pair, PairNumbers, PairTerm, Particles, World,
};

use super::{BoundFriction, OwnValues, PairFriction, Sum, ViscousTerm};
use crate::linear::{Block, Entry};
use crate::viscosity::{BoundCoupling, Coupling, CouplingRow, OwnViscosity, WithCoupling};

impl<const D: usize, F: PairFriction<D>> Coupling<D> for ViscousTerm<F> {
    fn access(&self) -> Access {
        PairTerm::<D>::access(self)
    }
    fn mixes_components(&self) -> bool {
        F::DIRECTIONAL
    }
    fn with_columns(
        &self,
        world: &World<D>,
        with: &mut WithCoupling<'_, D>,
    ) -> Result<(), StepError> {
        with(&PairTerm::bind(self, world)?)
    }
}

impl<const D: usize, F: PairFriction<D>> BoundFriction<'_, D, F> {
    /// −α and −β of a wall point times its viscosity.
    #[inline(always)]
    fn at_point(&self, here: &OwnValues<D>, there: f64, pair: &Pair<D>, eta: f64) -> [f64; 2] {
        let (distance2, factor) = (pair.distance2, pair.factor);
        let strengths = self
            .friction
            .strengths(here.volume, there, distance2, factor);
        strengths.map(|s| -(s * eta))
    }

    /// κ from the sums of the explicit term.
    fn correction_of(&self, here: &OwnValues<D>, rows: &Neighbourhood<'_, D>) -> f64 {
        if here.nearest.is_none() {
            return 1.0;
        }
        let mut sum = Sum::<D>::new([[0.0; D]; 2]);
        let volume = here.volume;
        for (j, pair) in rows.free.pairs() {
            let there = self.volume[j];
            let shear = self.friction.shear(volume, there, &here.along, &pair);
            sum.discrete += pair.separation * shear;
        }
        for (v, pair) in rows.wall.pairs() {
            let there = self.wall_volume[v];
            let shear = self.friction.shear(volume, there, &here.along, &pair);
            sum.discrete += pair.separation * (self.wall_share[v] * shear);
        }
        for contact in rows.contacts {
            if !self.is_open(contact.element) {
                sum.gradient += contact.gradient;
            }
        }
        self.correction(here, &sum)
    }
}

/// α, β and their norm of pairs.
struct Strengths<'a, 'b, const D: usize, F>(&'a BoundFriction<'b, D, F>);

/// Values of a particle in a pair.
#[derive(Clone, Copy)]
struct Own<L> {
    volume: L,
    density: L,
    viscosity: OwnViscosity<L>,
}

impl<const D: usize, F: PairFriction<D>> PairNumbers<D, 3> for Strengths<'_, '_, D, F> {
    type Own<L: Lane> = Own<L>;

    #[inline(always)]
    fn own<L: Lane>(&self, all: Particles) -> Own<L> {
        let bound = self.0;
        Own {
            volume: all.numbers(bound.volume),
            density: all.numbers(bound.density),
            viscosity: bound.viscosity.own(all),
        }
    }

    #[inline(always)]
    fn numbers<L: Lane>(&self, here: &Own<L>, j: usize, pair: &LanePair<D, L>) -> [L; 3] {
        let bound = self.0;
        let densities = [here.density, L::splat(bound.density[j])];
        let friction = bound.friction;
        let mean = friction.means(&bound.viscosity, &here.viscosity, j, densities);
        let there = L::splat(bound.volume[j]);
        let [even, along] = friction.strengths(here.volume, there, pair.distance2, pair.factor);
        let eta = L::splat(-bound.scale) * here.volume * mean;
        let [even, along] = [even * eta, along * eta];
        // A particle is infinitely far from itself, and the norm would not be a number.
        let norm = even.abs() + along.abs() * pair.distance2;
        let zero = L::splat(0.0);
        [even, along, (-pair.factor).where_positive(norm, zero)]
    }
}

impl<const D: usize, F: PairFriction<D>> BoundCoupling<D> for BoundFriction<'_, D, F> {
    fn kinds(&self) -> Kinds {
        Kinds {
            even: F::EVEN,
            along: F::DIRECTIONAL,
        }
    }

    fn strengths(&self, cluster: &Cluster<'_, D>, out: &mut Vec<f64>) {
        cluster.numbers(&Strengths(self), out);
    }

    fn walls_need_neighbours(&self, particle: usize) -> bool {
        self.nearest(particle).is_some()
    }

    fn scalar_walls(&self, rows: &Neighbourhood<'_, D>) -> CouplingRow<f64, D> {
        let here = self.own_values(rows.particle);
        let scale = self.scale * here.volume;
        let (mut wall, mut source) = (0.0, Vect::zeros());
        for (v, pair) in rows.wall.pairs() {
            let rubbing = self.rubbing(v, &pair) * here.viscosity.eta;
            let [friction, _] = self.at_point(&here, self.wall_volume[v], &pair, rubbing);
            wall += friction;
            source += self.wall_velocity[v] * friction;
        }
        let correction = self.correction_of(&here, rows);
        for contact in rows.contacts {
            let s = contact.element as usize;
            let normal = &self.elements.normal[s];
            let moving = self.elements.velocity_at(&contact);
            let friction = correction * self.weight(&here, &contact);
            let leaving = (here.velocity - moving).dot(normal);
            wall += friction;
            source += (moving + normal * leaving) * friction;
        }
        CouplingRow {
            wall: scale * wall,
            source: source * scale,
        }
    }

    fn block_walls(&self, rows: &Neighbourhood<'_, D>) -> CouplingRow<Block<D>, D> {
        let here = self.own_values(rows.particle);
        let scale = self.scale * here.volume;
        let (mut wall, mut source) = (Block::zeros(), Vect::zeros());
        for (v, pair) in rows.wall.pairs() {
            let rubbing = self.rubbing(v, &pair) * here.viscosity.eta;
            let [even, along] = self.at_point(&here, self.wall_volume[v], &pair, rubbing);
            let friction = Block::central(even, along, &pair.separation);
            wall += friction;
            source += friction * self.wall_velocity[v];
        }
        let correction = self.correction_of(&here, rows);
        for contact in rows.contacts {
            let s = contact.element as usize;
            let normal = &self.elements.normal[s];
            let along = Block::identity() - normal * normal.transpose();
            let friction = along * (correction * self.weight(&here, &contact));
            wall += friction;
            source += friction * self.elements.velocity_at(&contact);
        }
        CouplingRow {
            wall: wall * scale,
            source: source * scale,
        }
    }
}
