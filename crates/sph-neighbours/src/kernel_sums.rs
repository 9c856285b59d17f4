//! Sums of kernel values alone: the density sum, which prunes the lists, and Shepard means.

use rayon::prelude::*;
use sph_core::{StepError, Vect, fields};
use sph_kernels::Sampler;
use sph_lanes::{Body, Lane, dispatch_at, width};

use crate::list::CHUNK;
use crate::members::{Members, groups};
use crate::separation::Distances;
use crate::sweep::wrapping;
use crate::{Domain, NeighbourList, World};

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
                    let shares = row.iter().map(|&v| points.share[v as usize]);
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

/// Calls `use_row(target, candidates, w)` for every target and leaves what it returns in `out`: the
/// walk behind Shepard means at walls and probes. `w` is exactly zero beyond the support.
///
/// # Errors
/// If the world has no positions.
pub fn shepard<const D: usize, R: Send>(
    world: &World<D>,
    targets: &[Vect<D>],
    list: &NeighbourList,
    out: &mut Vec<R>,
    use_row: impl Fn(usize, &[u32], &[f64]) -> R + Sync,
) -> Result<(), StepError> {
    let positions = world.free.get(fields::POSITION)?;
    let kernel = &*world.kernel;
    let domain = world.domain.any_periodic().then_some(&world.domain);
    let rows = targets.par_iter().enumerate().with_min_len(CHUNK);
    let means = rows.map_init(
        || world.lists.shelf.lend::<Values>(),
        |values, (t, x)| {
            let row = list.row(t);
            let w = values.fill(x, positions, row, domain, kernel);
            use_row(t, row, w)
        },
    );
    means.collect_into_vec(out);
    Ok(())
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
