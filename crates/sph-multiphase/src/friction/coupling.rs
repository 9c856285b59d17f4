//! The rows of a friction's matrix.

use nalgebra::SMatrix;
use sph_core::{Access, StepError, Vect};
use sph_neighbours::{BoundTerm, Neighbourhood, Pair, PairTerm, Row, World};

use super::{Bound, Here, PairFriction, Sum, ViscousTerm};
use crate::viscosity::BoundViscosity;
use crate::{BoundCoupling, Coupling, CouplingRow, ViscositySource};

impl<const D: usize, F: PairFriction<D>, S: ViscositySource> Coupling<D> for ViscousTerm<F, S> {
    fn access(&self) -> Access {
        PairTerm::<D>::access(self)
    }
    fn mixes_components(&self) -> bool {
        F::DIRECTIONAL
    }
    fn bind<'a>(
        &'a self,
        world: &'a World<D>,
    ) -> Result<Box<dyn BoundCoupling<D> + 'a>, StepError> {
        Ok(Box::new(PairTerm::bind(self, world)?))
    }
}

type Block<const D: usize> = SMatrix<f64, D, D>;

fn pairs<'a, const D: usize>(row: &'a Row<'_, D>) -> impl Iterator<Item = (usize, Pair<D>)> + 'a {
    (0..row.index.len()).map(|k| {
        let pair = Pair {
            separation: row.separation[k],
            distance2: row.distance2[k],
            factor: row.factor[k],
        };
        (row.index[k] as usize, pair)
    })
}

impl<const D: usize, F: PairFriction<D>, S: BoundViscosity> Bound<'_, D, F, S> {
    /// −f for a unit velocity along the first axis.
    #[inline(always)]
    fn strength(&self, here: &Here<D, S::Here>, there: f64, pair: &Pair<D>) -> f64 {
        let mut unit = Vect::zeros();
        unit[0] = 1.0;
        -self.friction.force(here.volume, there, &unit, pair)[0]
    }

    /// −f for unit velocities along all axes.
    #[inline(always)]
    fn strengths(&self, here: &Here<D, S::Here>, there: f64, pair: &Pair<D>) -> Block<D> {
        let mut block = Block::<D>::zeros();
        for k in 0..D {
            let mut unit = Vect::zeros();
            unit[k] = 1.0;
            let force = self.friction.force(here.volume, there, &unit, pair);
            block.set_column(k, &-force);
        }
        block
    }

    /// κ from what the explicit term sums.
    fn correction_of(&self, here: &Here<D, S::Here>, rows: &Neighbourhood<'_, D>) -> f64 {
        if here.nearest.is_none() {
            return 1.0;
        }
        let mut sum: Sum<D> = self.zero();
        let volume = here.volume;
        for (j, pair) in pairs(&rows.free) {
            let there = self.volume[j];
            let shear = self.friction.shear(volume, there, &here.along, &pair);
            sum.discrete += pair.separation * shear;
        }
        for (v, pair) in pairs(&rows.wall) {
            let there = self.wall_volume[v];
            let shear = self.friction.shear(volume, there, &here.along, &pair);
            sum.discrete += pair.separation * (self.wall_share[v] * shear);
        }
        for contact in rows.contacts {
            sum.gradient += contact.gradient;
        }
        self.correction(here, &sum)
    }

    #[inline(always)]
    fn mean_with(&self, here: &Here<D, S::Here>, j: usize) -> f64 {
        let densities = [here.density, self.density[j]];
        self.friction
            .mean(&self.viscosity, &here.viscosity, j, densities)
    }
}

impl<const D: usize, F: PairFriction<D>, S: BoundViscosity> BoundCoupling<D>
    for Bound<'_, D, F, S>
{
    fn scalar_row(&self, rows: &Neighbourhood<'_, D>, out: &mut Vec<f64>) -> CouplingRow<f64, D> {
        let here = self.here(rows.particle);
        let scale = self.scale * here.volume;
        out.extend(pairs(&rows.free).map(|(j, pair)| {
            scale * self.mean_with(&here, j) * self.strength(&here, self.volume[j], &pair)
        }));
        let (mut wall, mut source) = (0.0, Vect::zeros());
        for (v, pair) in pairs(&rows.wall) {
            let rubbing = self.rubbing(v, &pair) * here.own_viscosity;
            let friction = rubbing * self.strength(&here, self.wall_volume[v], &pair);
            wall += friction;
            source += self.wall_velocity[v] * friction;
        }
        let correction = self.correction_of(&here, rows);
        for contact in rows.contacts {
            let s = contact.element as usize;
            let normal = &self.elements.normal[s];
            let moving = &self.elements.velocity[s];
            let friction = correction * self.weight(&here, contact);
            let leaving = (here.velocity - moving).dot(normal);
            wall += friction;
            source += (moving + normal * leaving) * friction;
        }
        CouplingRow {
            wall: scale * wall,
            source: source * scale,
        }
    }

    fn block_row(
        &self,
        rows: &Neighbourhood<'_, D>,
        out: &mut Vec<Block<D>>,
    ) -> CouplingRow<Block<D>, D> {
        let here = self.here(rows.particle);
        let scale = self.scale * here.volume;
        out.extend(pairs(&rows.free).map(|(j, pair)| {
            let mean = self.mean_with(&here, j);
            self.strengths(&here, self.volume[j], &pair) * (scale * mean)
        }));
        let (mut wall, mut source) = (Block::zeros(), Vect::zeros());
        for (v, pair) in pairs(&rows.wall) {
            let rubbing = self.rubbing(v, &pair) * here.own_viscosity;
            let friction = self.strengths(&here, self.wall_volume[v], &pair) * rubbing;
            wall += friction;
            source += friction * self.wall_velocity[v];
        }
        let correction = self.correction_of(&here, rows);
        for contact in rows.contacts {
            let s = contact.element as usize;
            let normal = &self.elements.normal[s];
            let along = Block::identity() - normal * normal.transpose();
            let friction = along * (correction * self.weight(&here, contact));
            wall += friction;
            source += friction * self.elements.velocity[s];
        }
        CouplingRow {
            wall: wall * scale,
            source: source * scale,
        }
    }
}
