//! Sums of kernel values alone: the density sum, which prunes the lists, and Shepard means.

use rayon::prelude::*;
use sph_core::{StepError, Vect, fields};
use sph_kernels::Sampler;

use crate::list::CHUNK;
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
    let list = &world.lists.free;
    let kernel = &*world.kernel;
    let own = kernel.value_at_zero();
    let limit = kernel.support_radius().powi(2);
    let row = |values: &mut Values, i: usize, slots: &mut [u32]| {
        let x = &positions[i];
        let domain = wrapping(&world.domain, x, world.reach());
        let (n, w) = values.prune(x, positions, list.row(i), limit, domain, kernel, slots);
        let mut sum = own + total(w);
        if points.in_sums() {
            let row = world.lists.wall.row(i);
            if !row.is_empty() {
                let w = values.fill(x, &points.position, row, domain, kernel);
                let shares = row.iter().map(|&v| points.share[v as usize]);
                sum += w
                    .iter()
                    .zip(shares)
                    .map(|(w, share)| w * share)
                    .sum::<f64>();
            }
        }
        (n, sum)
    };
    pruned.fill_rows(sums, |i| list.row(i).len(), Values::default, row);
    world.lists.pruned = Some(pruned);
    Ok(())
}

/// Calls `use_row(target, candidates, w)` for every target and collects what it returns: the
/// walk behind Shepard means at walls and probes. `w` is exactly zero beyond the support.
pub fn shepard<const D: usize, R: Send>(
    world: &World<D>,
    targets: &[Vect<D>],
    list: &NeighbourList,
    use_row: impl Fn(usize, &[u32], &[f64]) -> R + Sync,
) -> Result<Vec<R>, StepError> {
    let all = shepard_some(world, targets, list, |_, _| true, use_row)?;
    Ok(all.into_iter().flatten().collect())
}

/// The same for the targets whose candidates are `wanted`; no kernel value is taken for the others.
pub fn shepard_some<const D: usize, R: Send>(
    world: &World<D>,
    targets: &[Vect<D>],
    list: &NeighbourList,
    wanted: impl Fn(usize, &[u32]) -> bool + Sync,
    use_row: impl Fn(usize, &[u32], &[f64]) -> R + Sync,
) -> Result<Vec<Option<R>>, StepError> {
    let positions = world.free.get(fields::POSITION)?;
    let kernel = &*world.kernel;
    Ok(targets
        .par_iter()
        .enumerate()
        .with_min_len(CHUNK)
        .map_init(Values::default, |values, (t, x)| {
            let row = list.row(t);
            wanted(t, row).then(|| {
                let domain = world.domain.any_periodic().then_some(&world.domain);
                let w = values.fill(x, positions, row, domain, kernel);
                use_row(t, row, w)
            })
        })
        .collect())
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

    /// Kernel values of the candidates within the support; their indices go to `slots`.
    #[allow(clippy::too_many_arguments)]
    fn prune<const D: usize>(
        &mut self,
        x: &Vect<D>,
        sources: &[Vect<D>],
        candidates: &[u32],
        limit: f64,
        domain: Option<&Domain<D>>,
        kernel: &dyn Sampler,
        slots: &mut [u32],
    ) -> (usize, &[f64]) {
        let m = candidates.len();
        self.reserve(m);
        let (distance2, slots) = (&mut self.distance2[..m], &mut slots[..m]);
        let mut n = 0;
        for &j in candidates {
            let mut d = x - sources[j as usize];
            if let Some(domain) = domain {
                d = domain.nearest_image(d);
            }
            let r2 = d.norm_squared();
            slots[n] = j;
            distance2[n] = r2;
            n += usize::from(r2 < limit);
        }
        kernel.value(&distance2[..n], &mut self.value[..n]);
        (n, &self.value[..n])
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

/// A sum over four lanes in a fixed order.
fn total(values: &[f64]) -> f64 {
    let (whole, rest) = values.as_chunks::<4>();
    let mut lanes = [0.0; 4];
    for chunk in whole {
        for k in 0..4 {
            lanes[k] += chunk[k];
        }
    }
    (lanes[0] + lanes[2]) + (lanes[1] + lanes[3]) + rest.iter().sum::<f64>()
}
