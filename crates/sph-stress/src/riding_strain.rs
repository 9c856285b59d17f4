//! The strain rate as a term of the interaction sweep.

use std::sync::Arc;

use sph_core::{Access, StepError, Vect, fields};
use sph_neighbours::{
    BoundTerm, Contact, Lane, LanePair, LanePairTerm, LaneTerm, Pair, Rates, There, WallSet, World,
};

use crate::VelocityGradient;
use crate::gathered::{Gathered, LaneSums, add_free, one_lane, side_by_side};
use crate::strain_rate::magnitude;

/// [`STRAIN_RATE`](fields::STRAIN_RATE) along with the interactions, for those who read it after them: the walk over the
/// neighbours, their distances and the gradients of the kernel are there already.
#[derive(Clone)]
pub struct RidingStrain<const D: usize> {
    /// The formula of the gradient.
    pub formula: Arc<dyn VelocityGradient<D>>,
}

/// [`RidingStrain`] with its columns.
pub struct Bound<'a, const D: usize> {
    formula: &'a dyn VelocityGradient<D>,
    velocity: &'a [Vect<D>],
    walls: &'a WallSet<D>,
    slot: usize,
}

impl<const D: usize> LanePairTerm<D> for RidingStrain<D> {
    type Bound<'a> = Bound<'a, D>;

    fn name(&self) -> String {
        "strain rate".into()
    }
    fn access(&self) -> Access {
        Access::none()
            .both(fields::VELOCITY)
            .neighbours(fields::VOLUME)
            .writes(fields::STRAIN_RATE)
    }
    fn bind<'a>(&'a self, world: &'a World<D>) -> Result<Bound<'a, D>, StepError> {
        Ok(Bound {
            formula: &*self.formula,
            velocity: world.free.get(fields::VELOCITY)?,
            walls: &world.walls,
            slot: world.slot(fields::STRAIN_RATE)?,
        })
    }
}

impl<const D: usize> BoundTerm<D> for Bound<'_, D> {
    type Here = Vect<D>;
    type Sum = Gathered<D>;

    #[inline(always)]
    fn here(&self, i: usize) -> Vect<D> {
        self.velocity[i]
    }
    #[inline(always)]
    fn zero(&self) -> Gathered<D> {
        Gathered::default()
    }
    #[inline(always)]
    fn free(
        &self,
        own: &Vect<D>,
        j: usize,
        there: &There<D>,
        pair: &Pair<D>,
        sum: &mut Gathered<D>,
    ) {
        self.add_one(own, j, there, pair, sum);
    }
    #[inline(always)]
    fn wall(&self, own: &Vect<D>, v: usize, pair: &Pair<D>, sum: &mut Gathered<D>) {
        sum.point(own, &self.walls.points, v, &pair.separation, pair.factor);
    }
    #[inline(always)]
    fn element(&self, own: &Vect<D>, contact: &Contact<D>, sum: &mut Gathered<D>) {
        sum.element(own, &self.walls.elements, contact);
    }
    #[inline(always)]
    fn finish(
        &self,
        _: &Vect<D>,
        sum: &Gathered<D>,
        inverse_renormalisation: f64,
        rates: &mut Rates<D>,
    ) {
        rates.more[self.slot] += magnitude(&sum.gradient(self.formula, inverse_renormalisation));
    }
}

impl<const D: usize> LaneTerm<D> for Bound<'_, D> {
    type Side<L: Lane> = [L; D];
    /// Of free neighbours, and what they started from.
    type Sums<L: Lane> = (LaneSums<L, D>, Gathered<D>);

    #[inline(always)]
    fn side<L: Lane>(&self, here: &[Vect<D>]) -> [L; D] {
        side_by_side(here)
    }
    #[inline(always)]
    fn sums<L: Lane>(&self, sum: &Gathered<D>) -> Self::Sums<L> {
        ([[[L::splat(0.0); D]; D]; 2], *sum)
    }
    #[inline(always)]
    fn lane<L: Lane>(&self, (free, start): &Self::Sums<L>, lane: usize) -> Gathered<D> {
        start.with(one_lane(free, lane))
    }
    #[inline(always)]
    fn add<L: Lane>(
        &self,
        own: &[L; D],
        _: usize,
        there: &There<D>,
        pair: &LanePair<D, L>,
        (free, _): &mut Self::Sums<L>,
    ) {
        add_free(own, &there.velocity, there.volume, pair, free);
    }
}
