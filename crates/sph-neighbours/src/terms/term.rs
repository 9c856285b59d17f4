//! Pair terms: their sum over free neighbours is written once, for lanes; walls are added one by one.

use sph_core::{Access, StepError, contract};
use sph_kernels::lanes::InLanes;

use crate::pairs::pair_sum::sum_cluster;
use crate::{Cluster, LanePair, Neighbourhood, Pair, PairSum, Particles, Rates, Row, World};

impl<'a, const D: usize> Row<'a, D> {
    /// Its pairs, each with the index of the other.
    #[inline(always)]
    pub fn pairs(self) -> impl Iterator<Item = (usize, Pair<D>)> + 'a {
        let pairs = self.index.iter().zip(self.separation);
        let measures = self.distance2.iter().zip(self.factor);
        pairs
            .zip(measures)
            .map(|((&other, &separation), (&distance2, &factor))| {
                let pair = Pair {
                    separation,
                    distance2,
                    factor,
                };
                (other as usize, pair)
            })
    }
}

/// A pair term with its columns at hand.
pub trait BoundTerm<const D: usize>: PairSum<D> {
    /// Adds the walls near a particle to its sum over free neighbours, and turns it into rates.
    ///
    /// The free row of the neighbourhood may be empty.
    fn finish(&self, sum: Self::Sum<f64>, at: &Neighbourhood<'_, D>, rates: &mut Rates<D>);
}

/// A pair term, which finds its columns in the world. Every one is an [`Interaction`].
pub trait PairTerm<const D: usize>: Send + Sync + 'static {
    /// The term with its columns.
    type Bound<'a>: BoundTerm<D> + 'a;
    /// Name in plans.
    fn name(&self) -> String;
    /// Columns read, and written rates of scalars of its own ([`Rates::more`]); accelerations are the sweep's.
    fn access(&self) -> Access;
    /// Looks the columns up, once per sweep.
    ///
    /// # Errors
    /// If a column is missing.
    fn bind<'a>(&'a self, world: &'a World<D>) -> Result<Self::Bound<'a>, StepError>;
}

/// A term called once per particle with its whole neighbourhood.
pub trait RowTerm<const D: usize>: Sync {
    /// Adds the term's rates for one particle.
    fn row(&self, neighbourhood: &Neighbourhood<'_, D>, rates: &mut Rates<D>);
    /// Adds the rates of all particles of a cluster, row by row unless the term has a form of its own.
    fn cluster(&self, cluster: &mut Cluster<'_, D>, rates: &mut [Rates<D>]) {
        cluster.rows(|k, neighbourhood| self.row(neighbourhood, &mut rates[k]));
    }
}

/// The use of a term that has its columns.
pub type WithTerm<'w, const D: usize> = dyn FnMut(&dyn RowTerm<D>) -> Result<(), StepError> + 'w;

/// Terms of a sweep.
pub type Terms<const D: usize> = Vec<Box<dyn Interaction<D>>>;

/// A term as the sweep holds it. Implement [`PairTerm`], or this to work on whole rows.
pub trait Interaction<const D: usize>: Send + Sync {
    /// Name in plans.
    fn name(&self) -> String;
    /// Columns read, and written rates of scalars of its own ([`Rates::more`]); accelerations are the sweep's.
    fn access(&self) -> Access;
    /// Looks the columns up and calls `with`, once. The term with its columns is on the stack: no step allocates
    /// memory.
    ///
    /// # Errors
    /// If a column is missing, and those of `with`.
    fn with_columns(&self, world: &World<D>, with: &mut WithTerm<'_, D>) -> Result<(), StepError>;
}

contract!(
    /// A pair term that a scene may add to the built-in ones.
    pub TermEntry, "term", Any, "an additional term of the interaction sweep", Interaction<D>, .ordered(100)
);

impl<const D: usize, T: PairTerm<D>> Interaction<D> for T {
    fn name(&self) -> String {
        PairTerm::name(self)
    }
    fn access(&self) -> Access {
        PairTerm::access(self)
    }
    fn with_columns(&self, world: &World<D>, with: &mut WithTerm<'_, D>) -> Result<(), StepError> {
        with(&ByPairs(self.bind(world)?))
    }
}

/// The loops over a neighbourhood and over a cluster, compiled for a term.
pub struct ByPairs<B>(pub B);

impl<const D: usize, B: BoundTerm<D>> RowTerm<D> for ByPairs<B> {
    fn row(&self, at: &Neighbourhood<'_, D>, rates: &mut Rates<D>) {
        let own = self.0.own::<f64>(Particles::one(at.particle));
        let mut sum = B::Sum::<f64>::zero();
        let Some(scaling) = at.scaling.filter(|_| B::SCALED) else {
            for (j, pair) in at.free.pairs() {
                self.0.pair(&own, j, &(&pair).into(), &mut sum);
            }
            return self.0.finish(sum, at, rates);
        };
        for (j, pair) in at.free.pairs() {
            let (mut pair, scale) = (LanePair::from(&pair), scaling.of_pair(at.particle, j));
            pair.factor *= scale;
            pair.value = scale * scaling.kernel.at(pair.distance2.sqrt()).0;
            self.0.pair(&own, j, &pair, &mut sum);
            self.0.pair_at_walls(&own, j, &pair, &mut sum);
        }
        self.0.finish(sum, &at.scaled(), rates);
    }
    fn cluster(&self, cluster: &mut Cluster<'_, D>, rates: &mut [Rates<D>]) {
        let mut rows = std::mem::take(&mut cluster.buffers.sums);
        sum_cluster(&self.0, cluster, &mut rows);
        let scaled = B::SCALED && cluster.scaling.is_some();
        for (k, rates) in rates.iter_mut().enumerate() {
            let sum = B::Sum::<f64>::one(&rows, k);
            match scaled {
                true => self.0.finish(sum, &cluster.walls(k).scaled(), rates),
                false => self.0.finish(sum, &cluster.walls(k), rates),
            }
        }
        cluster.buffers.sums = rows;
    }
}
