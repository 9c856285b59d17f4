//! Walks over clusters that make something else than rates: of sums in lanes, rows of matrices, and results that are no
//! sums.

use std::ops::Range;

use sph_core::StepError;
use sph_kernels::Sampler;
use sph_kernels::lanes::{Body, InLanes, Lane, dispatch_at};

use crate::lists::buffer::grow;
use crate::pairs::pair_sum::sum_cluster;
use crate::terms::sweep::Sweep;
use crate::{CHUNK, Cluster, LanePair, Neighbourhood, PairSum, Particles, World, each_block};

/// Goes over the clusters of a world at the present places, block by block.
pub struct ClusterWalk<'w, const D: usize>(Sweep<'w, D, dyn Sampler>);

impl<'w, const D: usize> ClusterWalk<'w, D> {
    /// Of the particles of a world.
    ///
    /// # Errors
    /// If the world has no positions, as everywhere below.
    pub fn new(world: &'w World<D>) -> Result<Self, StepError> {
        Ok(ClusterWalk(Sweep::new(world, &*world.kernel)?))
    }

    /// Number of particles.
    pub fn particles(&self) -> usize {
        self.0.particles()
    }

    /// Number of blocks of [`CHUNK`] particles.
    pub fn blocks(&self) -> usize {
        self.particles().div_ceil(CHUNK)
    }

    /// Calls `visit` with the clusters of a block in the order of their particles, and the scratch memory at `hand`;
    /// where no member is `wanted` no neighbours are searched, and `others` gets the members.
    pub fn each_wanted<S>(
        &self,
        block: usize,
        hand: &mut S,
        wanted: impl Fn(usize) -> bool,
        mut visit: impl FnMut(&mut S, &mut Cluster<'_, D>),
        others: impl Fn(&mut S, Range<usize>),
    ) {
        let mut room = self.0.around.world.lists.pools.sweeps.acquire();
        for members in self.0.clusters(block) {
            match members.range().any(&wanted) {
                true => visit(hand, &mut self.0.measured(&mut room.0, members)),
                false => others(hand, members.range()),
            }
        }
    }
}

/// Numbers that a pair has, for several particles at once; exactly zero for a neighbour beyond the support, where F = 0.
pub trait PairNumbers<const D: usize, const M: usize>: Sync {
    /// Own values of `L::N` particles.
    type Own<L: Lane>: Copy;
    /// Reads the own values.
    fn own<L: Lane>(&self, particles: Particles) -> Self::Own<L>;
    /// The numbers.
    fn numbers<L: Lane>(
        &self,
        own: &Self::Own<L>,
        neighbour: usize,
        pair: &LanePair<D, L>,
    ) -> [L; M];
}

impl<const D: usize> Cluster<'_, D> {
    /// Runs a body with the lanes of the cluster.
    pub fn dispatch<B: Body>(&self, body: B) -> B::Output {
        dispatch_at(self.width, body)
    }

    /// The numbers of all pairs: for each candidate, for each of the `M` numbers, one per lane.
    pub fn numbers<const M: usize, P: PairNumbers<D, M>>(&self, pairs: &P, out: &mut Vec<f64>) {
        let needed = self.candidates().len() * M * self.lanes();
        grow(out, needed);
        let body = ClusterInLanes {
            pairs,
            cluster: self,
            out: &mut out[..needed],
        };
        dispatch_at(self.width, body);
    }
}

struct ClusterInLanes<'a, 'c, const D: usize, const M: usize, P> {
    pairs: &'a P,
    cluster: &'a Cluster<'c, D>,
    out: &'a mut [f64],
}

impl<const D: usize, const M: usize, P: PairNumbers<D, M>> Body
    for ClusterInLanes<'_, '_, D, M, P>
{
    type Output = ();

    #[inline(always)]
    fn call<L: Lane>(self) {
        let members = self.cluster.members;
        let own = self.pairs.own::<L>(members.into());
        let all = members.candidates.iter().enumerate();
        for ((k, &j), out) in all.zip(self.out.chunks_exact_mut(M * L::N)) {
            let numbers = self.pairs.numbers(&own, j as usize, &self.cluster.pair(k));
            for (number, out) in numbers.into_iter().zip(out.chunks_exact_mut(L::N)) {
                number.store(out);
            }
        }
    }
}

/// Results of `of` for the sum over free neighbours and the walls near every particle that is wanted, into a place per
/// particle; those of others stay as they are. The neighbourhood's free row is empty.
pub fn walk_in_lanes<const D: usize, S: PairSum<D>, R: Send>(
    world: &World<D>,
    sum: &S,
    wanted: impl Fn(usize) -> bool + Sync,
    out: &mut [R],
    of: impl Fn(S::Sum<f64>, &Neighbourhood<'_, D>) -> R + Sync,
) -> Result<(), StepError> {
    let sweep = Sweep::new(world, &*world.kernel)?;
    each_block(out, CHUNK, &|block, out| {
        let mut room = world.lists.pools.sweeps.acquire();
        sweep.each_wanted(block, &wanted, &mut room.0, |cluster| {
            if S::VALUES {
                let distances = cluster.candidates().len() * cluster.lanes();
                cluster.buffers.weigh(distances, &*world.kernel);
            }
            let mut rows = std::mem::take(&mut cluster.buffers.sums);
            sum_cluster(sum, cluster, &mut rows);
            for (k, i) in cluster.members().enumerate().filter(|(_, i)| wanted(*i)) {
                out[i - block * CHUNK] = of(S::Sum::<f64>::one(&rows, k), &cluster.walls(k));
            }
            cluster.buffers.sums = rows;
        });
    });
    Ok(())
}
