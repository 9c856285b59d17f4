//! Walks whose sums over free neighbours are written for lanes.

use sph_core::StepError;
use sph_lanes::{Body, Lane, MOST, dispatch_at, width};

use crate::blocks::each_block;
use crate::cluster::Cluster;
use crate::lane_pair::LanePair;
use crate::members::{Members, groups};
use crate::separation::places;
use crate::sweep::{Room, Sweep};
use crate::{CHUNK, Neighbourhood, World};

/// Sums over free neighbours of several particles at once, as [`LaneTerm`](crate::LaneTerm) has them for rates.
///
/// What it adds for a neighbour beyond the support, where F = 0, has to be exactly zero.
pub trait LaneSum<const D: usize>: Sync {
    /// Whether `add` gets kernel values.
    const VALUES: bool = false;
    /// What is read once per particle.
    type Here: Copy;
    /// What is summed for one.
    type Sum;
    /// What is read, of several particles.
    type Side<L: Lane>: Copy;
    /// What is summed, of several particles.
    type Sums<L: Lane>: Copy;
    /// Reads a particle's own values.
    fn here(&self, particle: usize) -> Self::Here;
    /// Puts the own values of `L::N` particles side by side.
    fn side<L: Lane>(&self, here: &[Self::Here]) -> Self::Side<L>;
    /// The empty sums.
    fn zero<L: Lane>(&self) -> Self::Sums<L>;
    /// The sum of one lane.
    fn lane<L: Lane>(&self, sums: &Self::Sums<L>, lane: usize) -> Self::Sum;
    /// Adds a free neighbour to all lanes; `value` is w, 1/m^d, where [`VALUES`](LaneSum::VALUES) asks for it, else 0.
    fn add<L: Lane>(
        &self,
        here: &Self::Side<L>,
        neighbour: usize,
        pair: &LanePair<D, L>,
        value: L,
        sums: &mut Self::Sums<L>,
    );
}

/// What `of` makes of the sum over free neighbours and of the walls near every particle that is wanted, into a place per
/// particle; those of others stay as they are. The neighbourhood's free row is empty.
///
/// # Errors
/// If the world has no positions.
pub fn walk_in_lanes<const D: usize, S: LaneSum<D>, R: Send>(
    world: &World<D>,
    sum: &S,
    wanted: impl Fn(usize) -> bool + Sync,
    out: &mut [R],
    of: impl Fn(S::Sum, &Neighbourhood<'_, D>) -> R + Sync,
) -> Result<(), StepError> {
    let sweep = Sweep::new(world, &[], &*world.kernel)?;
    let shelf = &world.lists.shelf;
    each_block(out, CHUNK, &|block, out| {
        let mut room = shelf.lend::<Room<D>>();
        for cluster in sweep.clusters(block) {
            for members in groups(cluster, width().lanes()) {
                let own = members.from..members.from + members.count;
                if !own.clone().any(&wanted) {
                    continue;
                }
                let mut cluster = sweep.measured(&mut room.0, members);
                if S::VALUES {
                    cluster.weigh(&*world.kernel);
                }
                let mut sums: [Option<S::Sum>; MOST] = std::array::from_fn(|_| None);
                let body = SideBySide {
                    sum,
                    cluster: &cluster,
                    out: &mut sums,
                };
                dispatch_at(cluster.width, body);
                for ((k, i), sum) in own.enumerate().zip(sums) {
                    let Some(sum) = sum.filter(|_| wanted(i)) else {
                        continue;
                    };
                    out[i - block * CHUNK] = of(sum, &cluster.walls(k));
                }
            }
        }
    });
    Ok(())
}

struct SideBySide<'a, 'c, const D: usize, S: LaneSum<D>> {
    sum: &'a S,
    cluster: &'a Cluster<'c, D>,
    out: &'a mut [Option<S::Sum>; MOST],
}

impl<const D: usize, S: LaneSum<D>> Body for SideBySide<'_, '_, D, S> {
    type Output = ();

    #[expect(
        clippy::needless_range_loop,
        reason = "iterators of the library would be calls here"
    )]
    #[inline(always)]
    fn call<L: Lane>(self) {
        let SideBySide { sum, cluster, out } = self;
        let Members {
            from,
            count,
            candidates,
        } = cluster.members;
        let mut heres = [sum.here(from); MOST];
        for (k, here) in heres.iter_mut().enumerate().take(L::N).skip(1) {
            *here = sum.here(from + k.min(count - 1));
        }
        let side = sum.side::<L>(&heres[..L::N]);
        let x = places::<D, L>(&cluster.positions[from..from + count]);
        let mut sums = sum.zero::<L>();
        let (distances, factors) = (&cluster.buffers.distance2, &cluster.buffers.factor);
        for k in 0..candidates.len() {
            let (j, lanes) = (candidates[k] as usize, k * L::N..(k + 1) * L::N);
            let pair = cluster.pair(&x, j, &distances[lanes.clone()], &factors[lanes]);
            let value = match S::VALUES {
                true => L::load(&cluster.buffers.value[k * L::N..]),
                false => L::splat(0.0),
            };
            sum.add(&side, j, &pair, value, &mut sums);
        }
        // A copy: single lanes are read from memory, and the sums themselves are to stay in registers.
        let all = sums;
        for (k, out) in out.iter_mut().enumerate().take(count) {
            *out = Some(sum.lane(&all, k));
        }
    }
}
