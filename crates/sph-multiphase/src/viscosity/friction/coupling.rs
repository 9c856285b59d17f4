//! The rows of a friction's matrix.

use sph_core::{Access, StepError, Vect};
use sph_neighbours::{
    Cluster, Kinds, Lane, LanePair, Neighbourhood, PairNumbers, PairTerm, Particles, World,
};

use super::{BoundFriction, OwnValues, PairFriction, ViscousTerm};
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
    /// W and s of walls; `at_element` gives the friction on an element, and the velocity to which it draws the particle, from
    /// the normal, the velocity of the element and its friction along the wall.
    fn walls<E: Entry<D>>(
        &self,
        rows: &Neighbourhood<'_, D>,
        at_element: impl Fn(&OwnValues<D>, &Vect<D>, Vect<D>, f64) -> (E, Vect<D>),
    ) -> CouplingRow<E, D> {
        let here = self.own_values(rows.particle);
        let scale = self.scale * here.volume;
        let (mut wall, mut source) = (E::ZERO, Vect::zeros());
        for (v, pair) in rows.wall.pairs() {
            let rubbing = self.rubbing(v, &pair) * here.viscosity.eta;
            let there = self.walls.points.volume[v];
            let factors =
                (self.friction).strengths(here.volume, there, pair.distance2, pair.factor);
            let [even, along] = factors.map(|s| -(s * rubbing));
            let friction = E::central(even, along, &pair.separation);
            wall = wall + friction;
            source += friction.apply(&self.walls.points.viscous_velocity[v]);
        }
        let mut discrete = Vect::zeros();
        if here.nearest.is_some() {
            for (j, pair) in rows.free.pairs() {
                let there = self.volume[j];
                let shear = self.friction.shear(here.volume, there, &here.along, &pair);
                discrete += pair.separation * shear;
            }
        }
        let correction = self.correction(&here, discrete, rows);
        for contact in rows.contacts {
            let normal = &self.walls.elements.normal[contact.element as usize];
            let moving = self.walls.elements.velocity_at(&contact);
            let friction = correction * self.weight(&here, &contact);
            let (friction, drawn) = at_element(&here, normal, moving, friction);
            wall = wall + friction;
            source += friction.apply(&drawn);
        }
        CouplingRow {
            wall: wall * scale,
            source: source * scale,
        }
    }
}

/// α, β and their norm of pairs.
impl<const D: usize, F: PairFriction<D>> PairNumbers<D, 3> for BoundFriction<'_, D, F> {
    /// V, ρ and η.
    type Own<L: Lane> = (L, L, OwnViscosity<L>);

    #[inline(always)]
    fn own<L: Lane>(&self, all: Particles) -> (L, L, OwnViscosity<L>) {
        let (volume, density) = (all.numbers(self.volume), all.numbers(self.density));
        (volume, density, self.viscosity.own(all))
    }

    #[inline(always)]
    fn numbers<L: Lane>(
        &self,
        (volume, density, viscosity): &(L, L, OwnViscosity<L>),
        j: usize,
        pair: &LanePair<D, L>,
    ) -> [L; 3] {
        let mean = self.means(viscosity, *density, j);
        let (friction, there) = (self.friction, L::splat(self.volume[j]));
        let [even, along] = friction.strengths(*volume, there, pair.distance2, pair.factor);
        let eta = L::splat(-self.scale) * *volume * mean;
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
        cluster.numbers(self, out);
    }
    fn walls_need_neighbours(&self, particle: usize) -> bool {
        self.nearest(particle).is_some()
    }
    fn scalar_walls(&self, rows: &Neighbourhood<'_, D>) -> CouplingRow<f64, D> {
        self.walls(rows, |here, normal, moving, friction| {
            let leaving = (here.velocity - moving).dot(normal);
            (friction, moving + normal * leaving)
        })
    }
    fn block_walls(&self, rows: &Neighbourhood<'_, D>) -> CouplingRow<Block<D>, D> {
        self.walls(rows, |_, normal, moving, friction| {
            let along = Block::identity() - normal * normal.transpose();
            (along * friction, moving)
        })
    }
}
