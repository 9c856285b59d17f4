//! Sums of kernel values alone: the density sum, which prunes the lists, and Shepard means.

use sph_core::{StepError, Vect, fields};
use sph_kernels::lanes::{Body, InLanes, Lane, MOST, dispatch_at, dot, width};

use crate::lanes::particles::Rows;
use crate::lists::buffer::grow;
use crate::lists::members::{Members, groups};
use crate::pairs::cluster::Buffers;
use crate::{
    CHUNK, Clusters, Domain, HiddenPairs, LanePair, PairSum, Particles, Surroundings, World,
    each_block, minus,
};

/// Σ θ_b w_ab over free neighbours, wall points and the particle itself, 1/m^d; s_a s_b w_ab where walls scale the kernel.
///
/// Since it computes all distances, it also leaves the list without its skin in
/// [`Lists::pruned`](crate::Lists::pruned) for the sweeps that follow at the same positions.
///
/// # Errors
/// If the world has no positions, as everywhere below.
pub fn kernel_sums<const D: usize>(
    world: &mut World<D>,
    sums: &mut [f64],
) -> Result<(), StepError> {
    let mut pruned = std::mem::take(&mut world.lists.spare);
    let around = Surroundings::new(world)?;
    let (points, hidden) = (&world.walls.points, &world.lists.hidden);
    let kernel = &*world.kernel;
    let own = kernel.value_at_zero();
    let scaling = around.scaling;
    let limit = kernel.support_radius().powi(2);
    let width = width();
    let cluster = |room: &mut Buffers<D>, all: Members<'_>, slots: &mut [u32], sums: &mut [f64]| {
        room.inside.clear();
        room.inside.resize(all.candidates.len(), false);
        for members in groups(all, width.lanes()) {
            let first = members.from - all.from;
            let domain = members.range().find_map(|i| around.wrapping(i));
            let places = around.position;
            let needed = room.find::<false>(width, members, places, domain, &hidden.particles);
            room.weigh(needed, kernel);
            let value = &mut room.value[..needed];
            if let Some(scaling) = scaling.filter(|s| s.acts(members)) {
                scaling.scale_pairs(width, members, value);
            }
            let total = Total {
                distance2: &room.distance2[..needed],
                value,
                limit,
                inside: &mut room.inside,
                sums: &mut sums[first..first + members.count],
            };
            dispatch_at(width, total);
        }
        for (k, sum) in sums.iter_mut().enumerate() {
            let i = all.from + k;
            *sum += scaling.map_or(own, |s| s.at(i).own_value);
            let wall = &mut room.walls[0];
            if points.in_density() && around.fill_wall(wall, i, around.wrapping(i), kernel) {
                let row = wall.row();
                let n = row.index.len();
                grow(&mut room.value, n);
                kernel.value(row.distance2, &mut room.value[..n]);
                let shares = row.index.iter().map(|v| points.share[*v as usize]);
                let parts = room.value[..n].iter().zip(shares).map(|(w, s)| w * s);
                *sum += parts.sum::<f64>();
            }
        }
        let mut n = 0;
        for (&j, &near) in all.candidates.iter().zip(&room.inside) {
            slots[n] = j;
            n += usize::from(near);
        }
        n
    };
    pruned.fill(&world.lists.free, sums, &world.lists.pools.sums, cluster);
    world.lists.pruned = Some(pruned);
    Ok(())
}

/// Σ w in every lane, and the particles within the support of any.
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

/// Leaves in `out` the results of `of` for the sums over the free particles around every target: those behind Shepard
/// means at walls. The particles of the sum's own values are the targets; pairs carry kernel values and no gradients.
///
/// Each sums its particles in the order of their indices, whatever the number of lanes; `hidden` has the pairs that are
/// left out.
pub fn shepard<const D: usize, S: PairSum<D>, R: Send>(
    world: &World<D>,
    targets: &[Vect<D>],
    (list, hidden): (&Clusters, &HiddenPairs),
    sum: &S,
    out: &mut Vec<R>,
    of: impl Fn(usize, S::Sum<f64>) -> R + Sync,
) -> Result<(), StepError> {
    let positions = world.free.get(fields::POSITION)?;
    let kernel = &*world.kernel;
    let width = width();
    out.resize_with(targets.len(), || {
        let none = vec![[0.0; MOST]; S::Sum::<f64>::NUMBERS];
        of(0, S::Sum::<f64>::one(&none, 0))
    });
    let limit = kernel.support_radius().powi(2);
    each_block(out, CHUNK, &|b, out| {
        let mut room = world.lists.pools.sums.acquire();
        let (buffers, inside) = &mut *room;
        for all in list.of_block(b) {
            for members in groups(all, width.lanes()) {
                let own = members.range();
                let mut near = targets[own.clone()].iter();
                let around = TargetPoints {
                    targets,
                    positions,
                    domain: near.find_map(|x| world.domain.wrapping(x, world.reach())),
                };
                let n = members.candidates.len();
                grow(&mut buffers.distance2, n * width.lanes());
                grow(inside, n);
                let body = DistancesAround {
                    around: &around,
                    members,
                    limit,
                    inside: &mut inside[..n],
                    out: &mut buffers.distance2,
                };
                let n = dispatch_at(width, body);
                let inside = &inside[..n];
                let near = Members {
                    candidates: inside,
                    ..members
                };
                hidden.part(near, width.lanes(), &mut buffers.distance2);
                let needed = inside.len() * width.lanes();
                buffers.weigh(needed, kernel);
                grow(&mut buffers.sums, S::Sum::<f64>::NUMBERS);
                let body = SumAround {
                    around: &around,
                    members,
                    inside,
                    values: &buffers.value[..needed],
                    sum,
                    rows: &mut buffers.sums,
                };
                dispatch_at(width, body);
                for (lane, target) in own.enumerate() {
                    let sum = S::Sum::<f64>::one(&buffers.sums, lane);
                    out[target - b * CHUNK] = of(target, sum);
                }
            }
        }
    });
    Ok(())
}

/// Some targets and the particles around them.
struct TargetPoints<'a, const D: usize> {
    /// Places of all targets, m.
    targets: &'a [Vect<D>],
    positions: &'a [Vect<D>],
    /// The domain, where images across periodic faces may be nearer.
    domain: Option<&'a Domain<D>>,
}

impl<const D: usize> TargetPoints<'_, D> {
    /// With a branch for the domain in the loop lanes would be taken apart: it is `WRAPS`, decided before.
    #[inline(always)]
    fn separation<L: Lane, const WRAPS: bool>(&self, x: &[L; D], particle: u32) -> [L; D] {
        let apart = minus(x, &self.positions[particle as usize]);
        match self.domain {
            Some(domain) if WRAPS => domain.nearest_images(apart),
            _ => apart,
        }
    }
}

/// Particles within the support of a target, and the squared distances of all targets, `N` numbers for each particle.
struct DistancesAround<'a, const D: usize> {
    around: &'a TargetPoints<'a, D>,
    members: Members<'a>,
    limit: f64,
    inside: &'a mut [u32],
    out: &'a mut [f64],
}

impl<const D: usize> Body for DistancesAround<'_, D> {
    /// Their number.
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
        let x = Particles::from(self.members).vectors::<D, L>(around.targets);
        let limit = L::splat(self.limit);
        let mut n = 0;
        for &j in self.members.candidates {
            let apart = around.separation::<L, WRAPS>(&x, j);
            let distance2 = dot(&apart, &apart);
            self.inside[n] = j;
            distance2.store(&mut self.out[n * L::N..]);
            n += usize::from(distance2.any_less(limit));
        }
        n
    }
}

/// The sums over all particles around some targets.
struct SumAround<'a, const D: usize, S> {
    around: &'a TargetPoints<'a, D>,
    members: Members<'a>,
    inside: &'a [u32],
    values: &'a [f64],
    sum: &'a S,
    rows: &'a mut Rows,
}

impl<const D: usize, S: PairSum<D>> Body for SumAround<'_, D, S> {
    type Output = ();

    #[inline(always)]
    fn call<L: Lane>(self) {
        match self.around.domain {
            Some(_) => self.add_up::<L, true>(),
            None => self.add_up::<L, false>(),
        }
    }
}

impl<const D: usize, S: PairSum<D>> SumAround<'_, D, S> {
    #[inline(always)]
    fn add_up<L: Lane, const WRAPS: bool>(self) {
        let targets = Particles::from(self.members);
        let x = targets.vectors::<D, L>(self.around.targets);
        let own = self.sum.own::<L>(targets);
        let mut sums = S::Sum::<L>::zero();
        let zero = L::splat(0.0);
        let values = self.values.chunks_exact(L::N);
        for (&j, w) in self.inside.iter().zip(values) {
            let separation = self.around.separation::<L, WRAPS>(&x, j);
            let pair = LanePair {
                separation,
                distance2: dot(&separation, &separation),
                factor: zero,
                value: L::load(w),
            };
            self.sum.pair(&own, j as usize, &pair, &mut sums);
        }
        sums.store(self.rows);
    }
}
