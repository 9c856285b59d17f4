//! Pair terms whose formula is written for lanes: the particles of a cluster stand side by side.

use std::any::Any;

use schemars::JsonSchema;
use serde::Deserialize;
use sph_core::{Access, StepError};
use sph_lanes::{Body, Lane, MOST, dispatch_at};

use crate::cluster::Cluster;
use crate::lane_pair::LanePair;
use crate::members::Members;
use crate::separation::places;
use crate::term::{each, free_then_walls};
use crate::{
    BoundTerm, Interaction, Neighbourhood, Pair, Part, Rates, RowTerm, There, WithTerm, World,
};

impl<const D: usize> From<&Pair<D>> for LanePair<D, f64> {
    #[inline(always)]
    fn from(pair: &Pair<D>) -> Self {
        let mut separation = [0.0; D];
        for (k, s) in separation.iter_mut().enumerate() {
            *s = pair.separation[k];
        }
        LanePair {
            separation,
            distance2: pair.distance2,
            factor: pair.factor,
        }
    }
}

/// A term with its columns at hand whose sum over free neighbours is written for lanes.
///
/// What it adds for a neighbour beyond the support, where F = 0, has to be exactly zero.
pub trait LaneTerm<const D: usize>: BoundTerm<D> {
    /// [`BoundTerm::Here`] of several particles.
    type Side<L: Lane>: Copy;
    /// [`BoundTerm::Sum`] of several particles.
    type Sums<L: Lane>: Copy;
    /// Puts the own values of `L::N` particles side by side.
    fn side<L: Lane>(&self, here: &[Self::Here]) -> Self::Side<L>;
    /// The same sum in all lanes.
    fn sums<L: Lane>(&self, sum: &Self::Sum) -> Self::Sums<L>;
    /// The sum of one lane.
    fn lane<L: Lane>(&self, sums: &Self::Sums<L>, lane: usize) -> Self::Sum;
    /// Adds a free neighbour to all lanes; `there` is its packed state.
    fn add<L: Lane>(
        &self,
        here: &Self::Side<L>,
        neighbour: usize,
        there: &There<D>,
        pair: &LanePair<D, L>,
        sums: &mut Self::Sums<L>,
    );
    /// [`LaneTerm::add`] for one particle: what [`BoundTerm::free`] has to do.
    #[inline(always)]
    fn add_one(
        &self,
        here: &Self::Here,
        neighbour: usize,
        there: &There<D>,
        pair: &Pair<D>,
        sum: &mut Self::Sum,
    ) {
        let side = self.side::<f64>(std::slice::from_ref(here));
        let mut sums = self.sums::<f64>(sum);
        self.add(&side, neighbour, there, &pair.into(), &mut sums);
        *sum = self.lane(&sums, 0);
    }
}

/// A term that finds its columns in the world, as [`PairTerm`](crate::PairTerm), with a formula for lanes.
pub trait LanePairTerm<const D: usize>: Send + Sync + 'static {
    /// The term with its columns.
    type Bound<'a>: LaneTerm<D> + 'a;
    /// Name in plans.
    fn name(&self) -> String;
    /// Columns read, and written rates of scalars of its own ([`Rates::more`]); accelerations are the sweep's.
    fn access(&self) -> Access;
    /// Looks the columns up, once per sweep.
    ///
    /// # Errors
    /// If a column is missing.
    fn bind<'a>(&'a self, world: &'a World<D>) -> Result<Self::Bound<'a>, StepError>;
    /// The terms that this one is fused of, each on its own.
    ///
    /// # Errors
    /// If a column is missing.
    fn parts<'a>(&'a self, world: &'a World<D>) -> Result<Vec<Part<'a, D>>, StepError> {
        let row: Box<dyn RowTerm<D> + 'a> = Box::new(FusedLanes(self.bind(world)?));
        Ok(vec![(self.name(), row)])
    }
}

/// Makes a [`LanePairTerm`] an [`Interaction`], with its parameters.
#[derive(Clone, Copy, Debug, Deserialize, JsonSchema)]
#[serde(transparent)]
pub struct Lanewise<T>(pub T);

impl<const D: usize, T: LanePairTerm<D>> Interaction<D> for Lanewise<T> {
    fn name(&self) -> String {
        self.0.name()
    }
    fn access(&self) -> Access {
        self.0.access()
    }
    fn bind<'a>(&'a self, world: &'a World<D>) -> Result<Box<dyn RowTerm<D> + 'a>, StepError> {
        Ok(Box::new(FusedLanes(self.0.bind(world)?)))
    }
    fn lend(&self, world: &World<D>, with: &mut WithTerm<'_, D>) -> Result<(), StepError> {
        with(&FusedLanes(self.0.bind(world)?))
    }
    fn parts<'a>(&'a self, world: &'a World<D>) -> Result<Vec<Part<'a, D>>, StepError> {
        self.0.parts(world)
    }
    fn as_any_ref(&self) -> &dyn Any {
        self
    }
    fn into_any(self: Box<Self>) -> Box<dyn Any> {
        self
    }
}

/// The loop over a cluster, compiled for the term (or tuple of terms) inside and for each width of lanes.
pub struct FusedLanes<B>(pub B);

impl<const D: usize, B: LaneTerm<D>> RowTerm<D> for FusedLanes<B> {
    #[inline]
    fn row(&self, n: &Neighbourhood<'_, D>, rates: &mut Rates<D>) {
        free_then_walls(&self.0, n, rates);
    }
    fn cluster(&self, cluster: &mut Cluster<'_, D>, rates: &mut [Rates<D>]) {
        let body = SideBySide {
            term: &self.0,
            cluster,
            rates,
        };
        dispatch_at(body.cluster.width, body);
    }
}

struct SideBySide<'a, 'c, const D: usize, B> {
    term: &'a B,
    cluster: &'a Cluster<'c, D>,
    rates: &'a mut [Rates<D>],
}

impl<const D: usize, B: LaneTerm<D>> Body for SideBySide<'_, '_, D, B> {
    type Output = ();

    #[expect(
        clippy::needless_range_loop,
        reason = "iterators of the library would be calls here"
    )]
    #[inline(always)]
    fn call<L: Lane>(self) {
        let SideBySide {
            term,
            cluster,
            rates,
        } = self;
        let Members {
            from,
            count,
            candidates,
        } = cluster.members;
        let mut heres = [term.here(from); MOST];
        for (k, here) in heres.iter_mut().enumerate().take(L::N).skip(1) {
            *here = term.here(from + k.min(count - 1));
        }
        let side = term.side::<L>(&heres[..L::N]);
        let x = places::<D, L>(&cluster.positions[from..from + count]);
        let mut sums = term.sums::<L>(&term.zero());
        let (distances, factors) = (&cluster.buffers.distance2, &cluster.buffers.factor);
        for k in 0..candidates.len() {
            let (j, lanes) = (candidates[k] as usize, k * L::N..(k + 1) * L::N);
            let pair = cluster.pair(&x, j, &distances[lanes.clone()], &factors[lanes]);
            term.add(&side, j, &cluster.states[j], &pair, &mut sums);
        }
        // A copy: single lanes are read from memory, and the sums themselves are to stay in registers.
        let all = sums;
        for (k, rates) in rates.iter_mut().enumerate() {
            let (here, mut sum) = (&heres[k], term.lane(&all, k));
            let row = cluster.buffers.walls[k].row();
            if !row.index.is_empty() {
                each(&row, |v, pair| term.wall(here, v, pair, &mut sum));
            }
            for contact in cluster.contacts.of(from + k) {
                term.element(here, &contact, &mut sum);
            }
            let inverse = cluster.renormalisation.map_or(1.0, |g| 1.0 / g[from + k]);
            term.finish(here, &sum, inverse, rates);
        }
    }
}

macro_rules! fused_tuple {
    ($($t:ident $k:tt),+) => {
        impl<const D: usize, $($t: LaneTerm<D>),+> LaneTerm<D> for ($($t,)+) {
            type Side<L: Lane> = ($($t::Side<L>,)+);
            type Sums<L: Lane> = ($($t::Sums<L>,)+);
            #[inline(always)]
            fn side<L: Lane>(&self, here: &[Self::Here]) -> Self::Side<L> {
                ($({
                    let mut own = [here[0].$k; MOST];
                    for lane in 1..L::N {
                        own[lane] = here[lane].$k;
                    }
                    self.$k.side::<L>(&own[..L::N])
                },)+)
            }
            #[inline(always)]
            fn sums<L: Lane>(&self, sum: &Self::Sum) -> Self::Sums<L> {
                ($(self.$k.sums::<L>(&sum.$k),)+)
            }
            #[inline(always)]
            fn lane<L: Lane>(&self, sums: &Self::Sums<L>, lane: usize) -> Self::Sum {
                ($(self.$k.lane::<L>(&sums.$k, lane),)+)
            }
            #[inline(always)]
            fn add<L: Lane>(
                &self,
                here: &Self::Side<L>,
                j: usize,
                there: &There<D>,
                pair: &LanePair<D, L>,
                sums: &mut Self::Sums<L>,
            ) {
                $(self.$k.add::<L>(&here.$k, j, there, pair, &mut sums.$k);)+
            }
        }
        impl<const D: usize, $($t: LanePairTerm<D>),+> LanePairTerm<D> for ($($t,)+) {
            type Bound<'a> = ($($t::Bound<'a>,)+);
            fn name(&self) -> String {
                [$(self.$k.name()),+].join(" + ")
            }
            fn access(&self) -> Access {
                Access::none()$(.and(self.$k.access()))+
            }
            fn bind<'a>(&'a self, world: &'a World<D>) -> Result<Self::Bound<'a>, StepError> {
                Ok(($(self.$k.bind(world)?,)+))
            }
            fn parts<'a>(&'a self, world: &'a World<D>) -> Result<Vec<Part<'a, D>>, StepError> {
                let mut parts = Vec::new();
                $(parts.extend(self.$k.parts(world)?);)+
                Ok(parts)
            }
        }
    };
}
fused_tuple!(A 0, B 1);
fused_tuple!(A 0, B 1, C 2);
fused_tuple!(A 0, B 1, C 2, E 3);
