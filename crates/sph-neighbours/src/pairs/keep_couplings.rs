//! Finding couplings cluster by cluster, and keeping those that are worth it.

use rayon::prelude::*;
use sph_core::{StepError, Vect};
use sph_kernels::lanes::{Body, Lane, MOST, dispatch_at, dot};

use crate::lanes::separation::places;
use crate::pairs::couplings::{BlockCouplings, Group};
use crate::{CHUNK, Cluster, ClusterWalk, Couplings, Kinds, World, minus, vector};

/// Pairs that are coupled too weakly to be kept: −C_ab (u_a − u_b) of a given velocity is summed in their place.
#[derive(Clone, Copy, Debug)]
pub struct Weak<'a, const D: usize> {
    /// With which they act, m/s.
    pub velocity: &'a [Vect<D>],
    /// The norm of C_ab is below that of either particle, N s/m.
    pub limit: &'a [f64],
}

/// The couplings of a particle.
#[derive(Clone, Copy, Debug)]
pub struct Tally<const D: usize> {
    /// Σ_b C_ab of those that are kept, N s/m.
    pub kept: nalgebra::SMatrix<f64, D, D>,
    /// −Σ_b C_ab (u_a − u_b) of those that are not, N.
    pub weak: Vect<D>,
}

/// Couplings of the clusters of a block.
pub struct CouplingWriter<'a> {
    kept: &'a mut BlockCouplings,
    kinds: Kinds,
    /// For code that finds couplings: α, β and their norm for every candidate, one number per lane each.
    pub numbers: &'a mut Vec<f64>,
}

/// Places that a particle has besides its couplings.
pub type Rows<'a, A, B, C> = (&'a mut [A], &'a mut [B], &'a mut [C]);

impl Couplings {
    /// Finds them anew. `cluster` hands those of a cluster to the [`CouplingWriter`]; `rows` has space for further results, three places per
    /// particle.
    ///
    /// # Errors
    /// If the world has no positions.
    pub fn fill<const D: usize, A: Send, B: Send, C: Send>(
        &mut self,
        world: &World<D>,
        kinds: Kinds,
        rows: Rows<'_, A, B, C>,
        cluster: impl Fn(&mut Cluster<'_, D>, &mut CouplingWriter<'_>, Rows<'_, A, B, C>) + Sync,
    ) -> Result<(), StepError> {
        let walk = ClusterWalk::new(world)?;
        self.kinds = kinds;
        self.blocks
            .resize_with(walk.blocks(), BlockCouplings::default);
        let (a, b, c) = rows;
        let rows = a.par_chunks_mut(CHUNK).zip(b.par_chunks_mut(CHUNK));
        let rows = rows.zip(c.par_chunks_mut(CHUNK));
        let blocks = self.blocks.par_iter_mut().zip(rows);
        let room = || world.lists.pools.numbers.acquire();
        blocks
            .enumerate()
            .for_each_init(room, |numbers, (block, (kept, ((a, b), c)))| {
                kept.groups.clear();
                kept.columns.clear();
                kept.numbers.clear();
                let mut writer = CouplingWriter {
                    kept,
                    kinds,
                    numbers,
                };
                let visit = |writer: &mut CouplingWriter<'_>, members: &mut Cluster<'_, D>| {
                    let first = members.members().start - block * CHUNK;
                    let own = first..first + members.members().len();
                    let rows = (&mut a[own.clone()], &mut b[own.clone()], &mut c[own]);
                    cluster(members, writer, rows);
                };
                walk.each_wanted(block, &mut writer, |_| true, visit, |_, _| ());
            });
        Ok(())
    }
}

impl CouplingWriter<'_> {
    /// Keeps the numbers of a cluster times `factor`, without the weak ones.
    pub fn keep<const D: usize>(
        &mut self,
        cluster: &Cluster<'_, D>,
        factor: f64,
        weak: Option<Weak<'_, D>>,
    ) -> [Tally<D>; MOST] {
        let own = cluster.members();
        let split = Split {
            cluster,
            numbers: &self.numbers[..3 * cluster.lanes() * cluster.candidates().len()],
            factor,
            weak,
            kinds: self.kinds,
            kept: &mut *self.kept,
        };
        let tallies = dispatch_at(cluster.width, split);
        self.kept.groups.push(Group {
            width: cluster.width,
            from: own.start as u32,
            count: own.len() as u32,
            to: self.kept.columns.len() as u32,
            wraps: cluster.wraps,
        });
        tallies
    }
}

struct Split<'a, 'c, const D: usize> {
    cluster: &'a Cluster<'c, D>,
    numbers: &'a [f64],
    factor: f64,
    weak: Option<Weak<'a, D>>,
    kinds: Kinds,
    kept: &'a mut BlockCouplings,
}

impl<const D: usize> Body for Split<'_, '_, D> {
    type Output = [Tally<D>; MOST];

    #[inline(always)]
    fn call<L: Lane>(self) -> Self::Output {
        let own = self.cluster.members();
        let zero = L::splat(0.0);
        // Lanes without a particle repeat the last one, which is near itself: their numbers are not used.
        let mut real = [0.0; MOST];
        real[..own.len()].fill(1.0);
        let real = L::load(&real);
        let mut limits = [0.0; MOST];
        let mut velocity = [zero; D];
        if let Some(weak) = self.weak {
            velocity = places::<D, L>(&weak.velocity[own.clone()]);
            limits[..own.len()].copy_from_slice(&weak.limit[own.clone()]);
        }
        let limit = L::load(&limits);
        let mut blocks = [[zero; D]; D];
        let mut force = [zero; D];
        let each = self.kinds.count() * L::N;
        let mut place = [0.0; 2 * MOST];
        let numbers = self.numbers.chunks_exact(3 * L::N);
        for (k, (&column, numbers)) in self.cluster.candidates().iter().zip(numbers).enumerate() {
            let norm = real.where_positive(L::load(&numbers[2 * L::N..]), zero);
            // Half of a cluster's candidates are beyond the support of any one member.
            if !norm.any_nonzero() {
                continue;
            }
            let j = column as usize;
            // Without `map`, which is a call in some builds, and then for the least processor.
            let even = real.where_positive(L::load(numbers), zero);
            let along = real.where_positive(L::load(&numbers[L::N..]), zero);
            let apart = self.cluster.separation::<L>(k);
            let mut softness = zero;
            if let Some(weak) = self.weak {
                let there = L::splat(weak.limit[j]);
                // No comparison with NaN is true: it is kept, and seen by the solver.
                softness = (limit - there).where_positive(there, limit) - norm;
                if zero.any_less(softness) {
                    let soft = [
                        softness.where_positive(even, zero),
                        softness.where_positive(along, zero),
                    ];
                    let relative = minus(&velocity, &weak.velocity[j]);
                    rub(&mut force, soft, &relative, &apart);
                }
            }
            let factor = L::splat(self.factor);
            let even = softness.where_positive(zero, even) * factor;
            let along = softness.where_positive(zero, along) * factor;
            if !(even.any_nonzero() || along.any_nonzero()) {
                continue;
            }
            self.kept.columns.push(column);
            if self.kinds.even {
                even.store(&mut place);
            }
            if self.kinds.along {
                along.store(&mut place[each - L::N..]);
            }
            self.kept.numbers.extend_from_slice(&place[..each]);
            add_block(&mut blocks, [even, along], &apart);
        }
        // Copies: single lanes are read from memory.
        let (blocks, force) = (blocks, force);
        let mut tallies = [tally(&blocks, &force, 0); MOST];
        for (lane, place) in tallies.iter_mut().enumerate().take(own.len()).skip(1) {
            *place = tally(&blocks, &force, lane);
        }
        tallies
    }
}

/// Takes α u + β (u·r) r from a force.
#[inline(always)]
fn rub<const D: usize, L: Lane>(
    force: &mut [L; D],
    [even, along]: [L; 2],
    relative: &[L; D],
    apart: &[L; D],
) {
    let turned = along * dot(relative, apart);
    for k in 0..D {
        force[k] -= relative[k] * even + apart[k] * turned;
    }
}

/// Adds the lower half of α 1 + β r rᵀ.
#[inline(always)]
fn add_block<const D: usize, L: Lane>(
    blocks: &mut [[L; D]; D],
    [even, along]: [L; 2],
    apart: &[L; D],
) {
    for i in 0..D {
        for k in 0..=i {
            blocks[i][k] += apart[i] * along * apart[k];
        }
        blocks[i][i] += even;
    }
}

/// Sums of a lane; of blocks the lower half.
#[inline(always)]
fn tally<const D: usize, L: Lane>(blocks: &[[L; D]; D], force: &[L; D], lane: usize) -> Tally<D> {
    let mut kept = nalgebra::SMatrix::zeros();
    for i in 0..D {
        for k in 0..=i {
            kept[(i, k)] = blocks[i][k].at(lane);
            kept[(k, i)] = blocks[i][k].at(lane);
        }
    }
    Tally {
        kept,
        weak: vector(force, lane),
    }
}
