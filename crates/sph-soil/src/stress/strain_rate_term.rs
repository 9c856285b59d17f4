//! The strain rate as a term of the interaction sweep.

use std::sync::Arc;

use sph_core::{Vect, fields};
use sph_neighbours::{
    BoundTerm, Lane, LanePair, Neighbourhood, PairSum, Particles, Rates, WallSet, pair_term,
};

use crate::stress::VelocityGradient;
use crate::stress::gathered::{Gathered, LaneSums, add_free};
use crate::stress::strain_rate::magnitude;

/// [`STRAIN_RATE`](fields::STRAIN_RATE) along with the interactions, for terms that read it after them: the walk over
/// the neighbours, their distances and the gradients of the kernel are there already.
#[derive(Clone)]
pub struct StrainRateTerm<const D: usize> {
    /// The formula of the gradient.
    pub formula: Arc<dyn VelocityGradient<D>>,
}

/// [`StrainRateTerm`] with its columns.
#[pair_term(StrainRateTerm<D>, "strain rate")]
pub struct BoundStrainRate<'a, const D: usize> {
    #[value(&*self.formula)]
    formula: &'a dyn VelocityGradient<D>,
    #[both(fields::VELOCITY)]
    velocity: &'a [Vect<D>],
    #[neighbours(fields::VOLUME)]
    volume: &'a [f64],
    #[value(&world.walls)]
    walls: &'a WallSet<D>,
    #[rate(fields::STRAIN_RATE)]
    slot: usize,
}

impl<const D: usize> PairSum<D> for BoundStrainRate<'_, D> {
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

impl<const D: usize> BoundTerm<D> for BoundStrainRate<'_, D> {
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
