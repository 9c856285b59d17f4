//! Walks that make something else than rates of sums in lanes.

use sph_core::StepError;
use sph_kernels::lanes::{InLanes, width};

use crate::blocks::each_block;
use crate::members::groups;
use crate::pair_sum::{PairSum, sum_cluster};
use crate::sweep::Sweep;
use crate::{CHUNK, Neighbourhood, World};

/// Results of `of` for the sum over free neighbours and the walls near every particle that is wanted, into a place per
/// particle; those of others stay as they are. The neighbourhood's free row is empty.
///
/// # Errors
/// If the world has no positions.
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
                let mut rows = std::mem::take(&mut cluster.buffers.sums);
                sum_cluster(sum, &cluster, &mut rows);
                for (k, i) in own.enumerate().filter(|(_, i)| wanted(*i)) {
                    let sum = S::Sum::<f64>::one(&rows, k);
                    out[i - block * CHUNK] = of(sum, &cluster.walls(k));
                }
                cluster.buffers.sums = rows;
            }
        }
    });
    Ok(())
}
