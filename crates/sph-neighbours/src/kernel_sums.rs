//! Sums of kernel values alone: the density sum, which prunes the lists, and Shepard means.

use std::ops::Range;

use sph_core::{StepError, Vect, fields};
use sph_kernels::Sampler;
use sph_lanes::{Body, Lane, MOST, dispatch_at, dot, width};

use crate::blocks::each_block;
use crate::lane_vector::minus;
use crate::list::{CHUNK, make_room};
use crate::members::{Members, groups};
use crate::separation::Distances;
use crate::sweep::wrapping;
use crate::{Blocked, Clusters, Domain, World};

/// Σ θ_b w_ab over free neighbours, wall points and the particle itself, 1/m^d.
///
/// Since it looks at all distances, it also leaves the list without its skin in
/// [`Lists::pruned`](crate::Lists::pruned) for the sweeps that follow at the same positions.
///
/// # Errors
/// If the world has no positions.
pub fn kernel_sums<const D: usize>(
    world: &mut World<D>,
    sums: &mut [f64],
) -> Result<(), StepError> {
    let mut pruned = std::mem::take(&mut world.lists.spare);
    let positions = world.free.get(fields::POSITION)?;
    let points = &world.walls.points;
    let kernel = &*world.kernel;
    let own = kernel.value_at_zero();
    let (blocked, unseen) = (&world.lists.hidden.particles, &world.lists.hidden.points);
    let limit = kernel.support_radius().powi(2);
    let width = width();
    let cluster = |room: &mut Room, all: Members<'_>, slots: &mut [u32], sums: &mut [f64]| {
        let domain = |i: usize| wrapping(&world.domain, &positions[i], world.reach());
        let mut inside = std::mem::take(&mut room.inside);
        inside.clear();
        inside.resize(all.candidates.len(), false);
        for members in groups(all, width.lanes()) {
            let first = members.from - all.from;
            let near = (members.from..members.from + members.count).find_map(domain);
            let out = &mut room.lanes.distance2;
            dispatch_at(
                width,
                Distances {
                    members,
                    positions,
                    domain: near,
                    out,
                },
            );
            let values = &mut room.lanes;
            let needed = members.candidates.len() * width.lanes();
            values.reserve(needed);
            blocked.part(members, width.lanes(), &mut values.distance2);
            let distance2 = &values.distance2[..needed];
            let value = &mut values.value[..needed];
            kernel.value(distance2, value);
            let sums = &mut sums[first..first + members.count];
            dispatch_at(
                width,
                Total {
                    distance2,
                    value,
                    limit,
                    inside: &mut inside,
                    sums,
                },
            );
        }
        for (k, sum) in sums.iter_mut().enumerate() {
            *sum += own;
            if points.in_density() {
                let i = all.from + k;
                let row = world.lists.wall.row(i);
                if !row.is_empty() {
                    let values = &mut room.row;
                    let w = values.fill(&positions[i], &points.position, row, domain(i), kernel);
                    let seen = |v: u32| f64::from(!unseen.has(i, v));
                    let shares = row.iter().map(|&v| seen(v) * points.share[v as usize]);
                    *sum += w
                        .iter()
                        .zip(shares)
                        .map(|(w, share)| w * share)
                        .sum::<f64>();
                }
            }
        }
        let mut n = 0;
        for (&j, &near) in all.candidates.iter().zip(&inside) {
            slots[n] = j;
            n += usize::from(near);
        }
        room.inside = inside;
        n
    };
    let shelf = &world.lists.shelf;
    pruned.fill(&world.lists.free, sums, shelf, cluster);
    world.lists.pruned = Some(pruned);
    Ok(())
}

/// Buffers of a thread.
#[derive(Default)]
struct Room {
    lanes: Values,
    row: Values,
    /// Which candidates some member has within its support.
    inside: Vec<bool>,
}

/// Σ w in every lane, and who is within the support of any.
struct Total<'a> {
    distance2: &'a [f64],
    value: &'a [f64],
    limit: f64,
    inside: &'a mut [bool],
    sums: &'a mut [f64],
}

impl Body for Total<'_> {
    type Output = ();

    #[inline(always)]
    fn call<L: Lane>(self) {
        let limit = L::splat(self.limit);
        let mut sum = L::splat(0.0);
        let lanes = self.distance2.chunks_exact(L::N);
        let lanes = lanes.zip(self.value.chunks_exact(L::N));
        for ((distance2, value), inside) in lanes.zip(self.inside) {
            sum += L::load(value);
            *inside |= L::load(distance2).any_less(limit);
        }
        for (lane, out) in self.sums.iter_mut().enumerate() {
            *out = sum.at(lane);
        }
    }
}

/// `K` sums over the free particles around targets, several of which stand side by side: those behind Shepard means at walls.
pub trait TargetMean<const D: usize, const K: usize>: Sync {
    /// What becomes of the sums.
    type Mean: Send;
    /// What the targets bring along, number by number in memory: from there it is loaded into lanes as a whole.
    type Here;
    /// The same in lanes.
    type Side<L: Lane>: Copy;

    /// What these targets have, at most [`MOST`].
    fn here(&self, targets: Range<usize>) -> Self::Here;
    /// Puts it side by side.
    fn side<L: Lane>(&self, here: &Self::Here) -> Self::Side<L>;
    /// Adds a particle: its index, the separations of the targets from it, m, and w, 1/m^d, exactly 0 beyond the support.
    fn add<L: Lane>(
        &self,
        side: &Self::Side<L>,
        particle: usize,
        apart: &[L; D],
        w: L,
        sums: &mut [L; K],
    );
    /// The mean at a target from its sums.
    fn mean(&self, target: usize, sums: [f64; K]) -> Self::Mean;
}

/// Leaves in `out` what a mean is at every target.
///
/// Each sums its particles in the order of their indices, whatever the number of lanes; `hidden` tells whom it does not see.
///
/// # Errors
/// If the world has no positions.
pub fn shepard<const D: usize, const K: usize, M: TargetMean<D, K>>(
    world: &World<D>,
    targets: &[Vect<D>],
    (list, hidden): (&Clusters, &Blocked),
    mean: &M,
    out: &mut Vec<M::Mean>,
) -> Result<(), StepError> {
    let positions = world.free.get(fields::POSITION)?;
    let kernel = &*world.kernel;
    let width = width();
    out.resize_with(targets.len(), || mean.mean(0, [0.0; K]));
    let limit = kernel.support_radius().powi(2);
    each_block(out, CHUNK, &|b, out| {
        let mut room = world.lists.shelf.lend::<(Values, Vec<u32>)>();
        let (values, inside) = &mut *room;
        for all in list.of_block(b) {
            for members in groups(all, width.lanes()) {
                let own = members.from..members.from + members.count;
                let mut near = targets[own.clone()].iter();
                let around = Around {
                    targets: in_memory(&targets[own.clone()]),
                    positions,
                    domain: near.find_map(|x| wrapping(&world.domain, x, world.reach())),
                };
                let n = members.candidates.len();
                values.reserve(n * width.lanes());
                make_room(inside, n);
                let body = DistancesAround {
                    around: &around,
                    candidates: members.candidates,
                    limit,
                    inside: &mut inside[..n],
                    out: &mut values.distance2,
                };
                let n = dispatch_at(width, body);
                let inside = &inside[..n];
                hidden.part(members.with(inside), width.lanes(), &mut values.distance2);
                let needed = inside.len() * width.lanes();
                let value = &mut values.value[..needed];
                kernel.value(&values.distance2[..needed], value);
                let mut sums = [[0.0; MOST]; K];
                let body = SumAround {
                    around: &around,
                    here: &mean.here(own.clone()),
                    inside,
                    values: value,
                    mean,
                    sums: &mut sums,
                };
                dispatch_at(width, body);
                for (lane, target) in own.enumerate() {
                    let sums = std::array::from_fn(|k| sums[k][lane]);
                    out[target - b * CHUNK] = mean.mean(target, sums);
                }
            }
        }
    });
    Ok(())
}

/// Vectors of at most [`MOST`] targets, component by component; the last one fills what is left over.
///
/// Lanes that are put together number by number are taken apart by the compiler, and each goes its own way.
pub type InMemory<const D: usize> = [[f64; MOST]; D];

/// Some vectors in memory.
///
/// # Panics
/// If there are none.
pub fn in_memory<const D: usize>(vectors: &[Vect<D>]) -> InMemory<D> {
    let last = vectors.len() - 1;
    std::array::from_fn(|k| std::array::from_fn(|lane| vectors[lane.min(last)][k]))
}

/// The vectors in lanes.
#[inline(always)]
pub fn loaded<const D: usize, L: Lane>(vectors: &InMemory<D>) -> [L; D] {
    let mut lanes = [L::splat(0.0); D];
    for k in 0..D {
        lanes[k] = L::load(&vectors[k]);
    }
    lanes
}

/// Some targets and the particles around them.
struct Around<'a, const D: usize> {
    /// Places of the targets, m.
    targets: InMemory<D>,
    positions: &'a [Vect<D>],
    /// Where images across periodic faces may be nearer.
    domain: Option<&'a Domain<D>>,
}

impl<const D: usize> Around<'_, D> {
    /// With a branch for the domain in the loop lanes would be taken apart: it is `WRAPS`, decided before.
    #[inline(always)]
    fn apart<L: Lane, const WRAPS: bool>(&self, x: &[L; D], particle: u32) -> [L; D] {
        let apart = minus(x, &self.positions[particle as usize]);
        match self.domain {
            Some(domain) if WRAPS => domain.nearest_images(apart),
            _ => apart,
        }
    }
}

/// Who is within the support of a target, and the squared distances of all targets, `N` numbers for each particle.
struct DistancesAround<'a, const D: usize> {
    around: &'a Around<'a, D>,
    candidates: &'a [u32],
    limit: f64,
    inside: &'a mut [u32],
    out: &'a mut [f64],
}

impl<const D: usize> Body for DistancesAround<'_, D> {
    /// How many there are.
    type Output = usize;

    #[inline(always)]
    fn call<L: Lane>(self) -> usize {
        match self.around.domain {
            Some(_) => self.find::<L, true>(),
            None => self.find::<L, false>(),
        }
    }
}

impl<const D: usize> DistancesAround<'_, D> {
    #[inline(always)]
    fn find<L: Lane, const WRAPS: bool>(self) -> usize {
        let around = self.around;
        let x = loaded::<D, L>(&around.targets);
        let limit = L::splat(self.limit);
        let mut n = 0;
        for &j in self.candidates {
            let apart = around.apart::<L, WRAPS>(&x, j);
            let distance2 = dot(&apart, &apart);
            self.inside[n] = j;
            distance2.store(&mut self.out[n * L::N..]);
            n += usize::from(distance2.any_less(limit));
        }
        n
    }
}

/// The sums over all particles.
struct SumAround<'a, const D: usize, const K: usize, M: TargetMean<D, K>> {
    around: &'a Around<'a, D>,
    here: &'a M::Here,
    inside: &'a [u32],
    values: &'a [f64],
    mean: &'a M,
    sums: &'a mut [[f64; MOST]; K],
}

impl<const D: usize, const K: usize, M: TargetMean<D, K>> Body for SumAround<'_, D, K, M> {
    type Output = ();

    #[inline(always)]
    fn call<L: Lane>(self) {
        match self.around.domain {
            Some(_) => self.sum::<L, true>(),
            None => self.sum::<L, false>(),
        }
    }
}

impl<const D: usize, const K: usize, M: TargetMean<D, K>> SumAround<'_, D, K, M> {
    #[inline(always)]
    fn sum<L: Lane, const WRAPS: bool>(self) {
        let (around, mean) = (self.around, self.mean);
        let x = loaded::<D, L>(&around.targets);
        let side = mean.side::<L>(self.here);
        let mut sums = [L::splat(0.0); K];
        let values = self.values.chunks_exact(L::N);
        for (&j, w) in self.inside.iter().zip(values) {
            let apart = around.apart::<L, WRAPS>(&x, j);
            mean.add(&side, j as usize, &apart, L::load(w), &mut sums);
        }
        let all = sums.into_iter().zip(self.sums);
        all.for_each(|(sum, to)| sum.store(to));
    }
}

#[derive(Default)]
struct Values {
    distance2: Vec<f64>,
    value: Vec<f64>,
}

impl Values {
    fn reserve(&mut self, n: usize) {
        if self.value.len() < n {
            self.distance2.resize(n.next_power_of_two(), 0.0);
            self.value.resize(n.next_power_of_two(), 0.0);
        }
    }

    fn fill<const D: usize>(
        &mut self,
        x: &Vect<D>,
        sources: &[Vect<D>],
        candidates: &[u32],
        domain: Option<&Domain<D>>,
        kernel: &dyn Sampler,
    ) -> &[f64] {
        let n = candidates.len();
        self.reserve(n);
        let distance2 = &mut self.distance2[..n];
        match domain {
            None => {
                for (r2, &j) in distance2.iter_mut().zip(candidates) {
                    *r2 = (x - sources[j as usize]).norm_squared();
                }
            }
            Some(domain) => {
                for (r2, &j) in distance2.iter_mut().zip(candidates) {
                    *r2 = domain.nearest_image(x - sources[j as usize]).norm_squared();
                }
            }
        }
        kernel.value(distance2, &mut self.value[..n]);
        &self.value[..n]
    }
}
