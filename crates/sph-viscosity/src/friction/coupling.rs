//! The rows of a friction's matrix.

use nalgebra::SMatrix;
use sph_core::{Access, StepError, Vect};
use sph_neighbours::{BoundTerm, LanePairTerm, Neighbourhood, Pair, Row, World};

use super::{Bound, Here, PairFriction, Sum, ViscousTerm};
use crate::viscosity_source::BoundViscosity;
use crate::{BoundCoupling, Coupling, CouplingRow, ViscositySource, Weak};

impl<const D: usize, F: PairFriction<D>, S: ViscositySource> Coupling<D> for ViscousTerm<F, S> {
    fn access(&self) -> Access {
        LanePairTerm::<D>::access(self)
    }
    fn mixes_components(&self) -> bool {
        F::DIRECTIONAL
    }
    fn bind<'a>(
        &'a self,
        world: &'a World<D>,
    ) -> Result<Box<dyn BoundCoupling<D> + 'a>, StepError> {
        Ok(Box::new(LanePairTerm::bind(self, world)?))
    }
}

type Block<const D: usize> = SMatrix<f64, D, D>;

/// α 1 + β r rᵀ.
#[inline(always)]
fn block<const D: usize>([even, along]: [f64; 2], pair: &Pair<D>) -> Block<D> {
    let r = &pair.separation;
    let scaled = r * along;
    Block::from_fn(|i, k| scaled[i] * r[k] + if i == k { even } else { 0.0 })
}

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
    /// −α and −β of a pair times its viscosity.
    #[inline(always)]
    fn strengths(&self, here: &Here<D, S::Here>, there: f64, pair: &Pair<D>, eta: f64) -> [f64; 2] {
        let (distance2, factor) = (pair.distance2, pair.factor);
        let strengths = self
            .friction
            .strengths(here.volume, there, distance2, factor);
        strengths.map(|s| -(s * eta))
    }

    /// Appends what couples `here` to free neighbours as `entry` writes it; the force of the weak pairs.
    #[inline(always)]
    fn couple<E>(
        &self,
        here: &Here<D, S::Here>,
        rows: &Neighbourhood<'_, D>,
        weak: Option<Weak<'_, D>>,
        out: &mut Vec<(u32, E)>,
        entry: impl Fn([f64; 2], &Pair<D>) -> E,
    ) -> Vect<D> {
        let scale = self.scale * here.volume;
        let mut source = Vect::zeros();
        let i = rows.particle;
        for (j, pair) in pairs(&rows.free) {
            let eta = scale * self.mean_with(here, j);
            let [even, along] = self.strengths(here, self.volume[j], &pair, eta);
            let norm = even.abs() + along.abs() * pair.distance2;
            if norm == 0.0 {
                continue;
            }
            if let Some(weak) = weak
                && norm <= weak.limit[i].min(weak.limit[j])
            {
                let u = weak.velocity[i] - weak.velocity[j];
                source -= u * even + pair.separation * (along * u.dot(&pair.separation));
                continue;
            }
            out.push((j as u32, entry([even, along], &pair)));
        }
        source
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
        let own = self
            .viscosity
            .side::<f64>(std::slice::from_ref(&here.viscosity));
        self.friction.means(&self.viscosity, &own, j, densities)
    }
}

impl<const D: usize, F: PairFriction<D>, S: BoundViscosity> BoundCoupling<D>
    for Bound<'_, D, F, S>
{
    fn scalar_row(
        &self,
        rows: &Neighbourhood<'_, D>,
        weak: Option<Weak<'_, D>>,
        out: &mut Vec<(u32, f64)>,
    ) -> CouplingRow<f64, D> {
        let here = self.here(rows.particle);
        let scale = self.scale * here.volume;
        let of_weak = self.couple(&here, rows, weak, out, |[even, _], _| even);
        let (mut wall, mut source) = (0.0, Vect::zeros());
        for (v, pair) in pairs(&rows.wall) {
            let rubbing = self.rubbing(v, &pair) * here.own_viscosity;
            let [friction, _] = self.strengths(&here, self.wall_volume[v], &pair, rubbing);
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
            source: source * scale + of_weak,
        }
    }

    fn block_row(
        &self,
        rows: &Neighbourhood<'_, D>,
        weak: Option<Weak<'_, D>>,
        out: &mut Vec<(u32, Block<D>)>,
    ) -> CouplingRow<Block<D>, D> {
        let here = self.here(rows.particle);
        let scale = self.scale * here.volume;
        let of_weak = self.couple(&here, rows, weak, out, block);
        let (mut wall, mut source) = (Block::zeros(), Vect::zeros());
        for (v, pair) in pairs(&rows.wall) {
            let rubbing = self.rubbing(v, &pair) * here.own_viscosity;
            let strengths = self.strengths(&here, self.wall_volume[v], &pair, rubbing);
            let friction = block(strengths, &pair);
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
            source: source * scale + of_weak,
        }
    }
}
