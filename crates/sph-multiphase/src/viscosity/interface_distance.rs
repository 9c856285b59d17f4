//! Distance of particles from the next phase.

use rayon::prelude::*;
use sph_core::{Access, Field, Scalar, Stage, fields, stage};
use sph_kernels::Sampler;
use sph_neighbours::{Around, Values, World, walk_into};

/// Distance of a particle from the interface of its phase; the support's radius without an interface in reach.
pub const INTERFACE_DISTANCE: Field<Scalar> =
    Field::new("interface_distance", "m", "distance from the next phase");

/// Least distance over the support's radius: no particle is on the interface itself.
const LEAST: f64 = 1e-3;

/// d from c(d) = Σ_other V w / Σ V w, c being the share of the kernel beyond a plane at d.
///
/// On a lattice with h = 2δr the distance of the first rows is met to 1 % of δr; at curved interfaces to δr²/R.
pub(super) fn interface_distance<const D: usize>() -> impl Stage<World<D>> {
    let access = Access::none()
        .both((fields::POSITION, fields::VOLUME, fields::PHASE))
        .writes(INTERFACE_DISTANCE);
    let mut beyond = None;
    // Particles with another phase within the reach of their list; phases change with the lists only.
    let (mut builds, mut mixed) = (0, Vec::new());
    let name = "distance from the interface";
    stage(name, access, move |world: &mut World<D>| {
        let mut distance = world.free.take(INTERFACE_DISTANCE)?;
        let (volume, phase) = world.free.all((fields::VOLUME, fields::PHASE))?;
        let kernel = &*world.kernel;
        let own = kernel.value_at_zero();
        let beyond = beyond.get_or_insert_with(|| KernelTail::new(kernel));
        let lists = world.lists.nearest();
        let unlike = |i: usize, j: &u32| phase[*j as usize] != phase[i];
        if builds != world.lists.builds || mixed.len() != phase.len() {
            builds = world.lists.builds;
            let all = (0..phase.len()).into_par_iter().with_min_len(1024);
            let near = |i| world.lists.free.candidates(i).iter().any(|j| unlike(i, j));
            all.map(near).collect_into_vec(&mut mixed);
        }
        let near = |i: usize| mixed[i] && lists.candidates(i).iter().any(|j| unlike(i, j));
        // First the shares, where they differ from 0.
        distance.fill(0.0);
        let share = |around: &Around<'_, D>| {
            let i = around.rows.particle;
            let (mut other, mut all) = (0.0, volume[i] * own);
            for (&j, w) in around.rows.free.index.iter().zip(around.free) {
                let j = j as usize;
                let part = volume[j] * w;
                all += part;
                other += if phase[j] == phase[i] { 0.0 } else { part };
            }
            other / all
        };
        walk_into(world, Values::Both, near, &mut distance, share)?;
        let all = distance.par_iter_mut().with_min_len(1024);
        all.for_each(|d| *d = beyond.distance(*d));
        Ok(world.free.put(INTERFACE_DISTANCE, distance)?)
    })
}

/// The share of the kernel beyond a plane, tabulated over the distance.
struct KernelTail {
    radius: f64,
    /// At equal steps from 0 to the radius: from 1/2 down to 0.
    share: Vec<f64>,
}

impl KernelTail {
    const STEPS: usize = 256;

    fn new(kernel: &dyn Sampler) -> Self {
        let radius = kernel.support_radius();
        let dimension = kernel.dimension();
        // ∫_d^R w(r) a(r, d) dr with a the part beyond the plane of the circle or sphere of radius r,
        // by the middle rule; scaled to 1/2 at d = 0.
        let at = |d: f64| -> f64 {
            let steps = 4 * Self::STEPS;
            let width = (radius - d) / steps as f64;
            let part = |k: usize| {
                let r = d + (k as f64 + 0.5) * width;
                let cap = match dimension {
                    2 => 2.0 * r * (d / r).acos(),
                    _ => std::f64::consts::TAU * r * (r - d),
                };
                kernel.at(r).0 * cap
            };
            (0..steps).map(part).sum::<f64>() * width
        };
        let whole = 2.0 * at(0.0);
        let step = radius / Self::STEPS as f64;
        let share = (0..=Self::STEPS).map(|k| at(k as f64 * step) / whole);
        KernelTail {
            radius,
            share: share.collect(),
        }
    }

    /// The distance with this share; a phase that is thinner than its distance counts as near.
    fn distance(&self, share: f64) -> f64 {
        let after = self.share.partition_point(|s| *s > share);
        if after == 0 {
            return LEAST * self.radius;
        }
        let last = Self::STEPS;
        if after > last {
            return self.radius;
        }
        let (high, low) = (self.share[after - 1], self.share[after]);
        let part = (high - share) / (high - low).max(f64::MIN_POSITIVE);
        let distance = (after as f64 - 1.0 + part) * self.radius / last as f64;
        distance.max(LEAST * self.radius)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use sph_kernels::{Kernel, wendland_c2};

    #[test]
    fn the_table_is_inverted_to_1e_4_of_the_radius() {
        for dimension in [2, 3] {
            let beyond = KernelTail::new(&*wendland_c2().sampler(dimension, 0.5));
            assert_eq!(beyond.share[0], 0.5);
            for k in 0..=100 {
                let d = 0.0085 * f64::from(k);
                let at = d * KernelTail::STEPS as f64;
                let (low, part) = (at.floor() as usize, at.fract());
                let share = beyond.share[low] * (1.0 - part) + beyond.share[low + 1] * part;
                let found = beyond.distance(share);
                assert!((found - d.max(LEAST)).abs() < 1e-4, "{found} for {d}");
            }
        }
    }
}
