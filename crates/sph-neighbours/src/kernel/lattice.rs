//! Sums over the sites of a lattice with the scene's spacing and kernel.

use sph_core::Vect;

use crate::{Pair, World};

/// Σ f over the pairs that a site makes with all others in its support.
pub fn lattice_sum<const D: usize>(world: &World<D>, f: impl Fn(&Pair<D>) -> f64) -> f64 {
    shifted_sum(world, 0.0, f)
}

/// Places of the rows over which [`rows_sum`] takes its mean: f is smooth and periodic, more change nothing.
const PLACES: usize = 16;

/// The mean of Σ f over all places along x of the rows y ≠ 0: rows that slide past each other take all of them.
pub fn rows_sum<const D: usize>(world: &World<D>, f: impl Fn(&Pair<D>) -> f64) -> f64 {
    let share = |k: usize| (k as f64 + 0.5) / PLACES as f64;
    let sums = (0..PLACES).map(|k| shifted_sum(world, share(k), &f));
    sums.sum::<f64>() / PLACES as f64
}

/// With the rows y ≠ 0 moved along x by a share of the spacing.
fn shifted_sum<const D: usize>(world: &World<D>, shift: f64, f: impl Fn(&Pair<D>) -> f64) -> f64 {
    let (spacing, radius) = (world.spacing, world.kernel.support_radius());
    let reach = (radius / spacing).ceil() as i64 + i64::from(shift > 0.0);
    let side = (2 * reach + 1) as usize;
    let of = |k: usize| {
        let place = |axis: usize| ((k / side.pow(axis as u32)) % side) as i64 - reach;
        let mut separation = Vect::<D>::from_fn(|axis, _| place(axis) as f64 * spacing);
        if separation[1] != 0.0 {
            separation[0] += shift * spacing;
        }
        let distance2 = separation.norm_squared();
        if distance2 == 0.0 || distance2 >= radius * radius {
            return 0.0;
        }
        f(&Pair {
            separation,
            distance2,
            factor: world.kernel.at(distance2.sqrt()).1,
        })
    };
    (0..side.pow(D as u32)).map(of).sum()
}
