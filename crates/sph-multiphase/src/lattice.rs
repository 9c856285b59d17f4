//! Sums over the sites of a lattice with the scene's spacing and kernel.

use sph_core::Vect;
use sph_neighbours::{Pair, World};

/// Σ f over the pairs that a site makes with all others in its support.
pub fn lattice_sum<const D: usize>(world: &World<D>, f: impl Fn(&Pair<D>) -> f64) -> f64 {
    let (spacing, radius) = (world.spacing, world.kernel.support_radius());
    let reach = (radius / spacing).ceil() as i64;
    let side = (2 * reach + 1) as usize;
    let of = |k: usize| {
        let place = |axis: usize| ((k / side.pow(axis as u32)) % side) as i64 - reach;
        let separation = Vect::<D>::from_fn(|axis, _| place(axis) as f64 * spacing);
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
