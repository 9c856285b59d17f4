//! Worlds of particles at known places.

use sph_core::{Store, Vect};
use sph_kernels::{Kernel, wendland_c2};
use sph_neighbours::{Domain, World};

/// Particles in an open box around the unit square, without walls, gravity or lists.
pub fn world(free: Store<2>, spacing: f64) -> World<2> {
    World {
        free,
        walls: Default::default(),
        lists: Default::default(),
        domain: Domain::open(Vect::from([-1.0, -1.0]), Vect::from([2.0, 2.0])),
        kernel: wendland_c2().sampler(2, 2.0 * spacing),
        spacing,
        skin: 0.1,
        gravity: Vect::zeros(),
        driving: Vect::zeros(),
        time: 0.0,
        dt: 1.0,
    }
}
