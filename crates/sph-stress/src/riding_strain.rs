//! The strain rate as a term of the interaction sweep.

use std::sync::Arc;

use sph_core::{Access, StepError, Vect, fields};
use sph_neighbours::{
    BoundTerm, Lane, LanePair, Neighbourhood, PairSum, PairTerm, Particles, Rates, WallSet, World,
};

use crate::VelocityGradient;
use crate::gathered::{Gathered, LaneSums, add_free};
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
    volume: &'a [f64],
    walls: &'a WallSet<D>,
    slot: usize,
}

impl<const D: usize> PairTerm<D> for RidingStrain<D> {
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
            volume: world.free.get(fields::VOLUME)?,
            walls: &world.walls,
            slot: world.slot(fields::STRAIN_RATE)?,
        })
    }
}

impl<const D: usize> PairSum<D> for Bound<'_, D> {
    type Own<L: Lane> = [L; D];
    type Sum<L: Lane> = LaneSums<L, D>;

    #[inline(always)]
    fn own<L: Lane>(&self, all: Particles) -> [L; D] {
        all.vectors(self.velocity)
    }
    #[inline(always)]
    fn pair<L: Lane>(
        &self,
        own: &[L; D],
        j: usize,
        pair: &LanePair<D, L>,
        sum: &mut LaneSums<L, D>,
    ) {
        add_free(own, &self.velocity[j], self.volume[j], pair, sum);
    }
}

impl<const D: usize> BoundTerm<D> for Bound<'_, D> {
    #[inline(always)]
    fn finish(&self, free: LaneSums<f64, D>, at: &Neighbourhood<'_, D>, rates: &mut Rates<D>) {
        let own = &self.velocity[at.particle];
        let gathered = Gathered::default()
            .with(free)
            .with_walls(own, self.walls, at);
        let gradient = gathered.gradient(self.formula, at.inverse_renormalisation);
        rates.more[self.slot] += magnitude(&gradient);
    }
}
