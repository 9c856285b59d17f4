//! Worlds of particles at known places.

use sph_core::{Store, Vect};
use sph_kernels::{Kernel, wendland_c2};
use sph_neighbours::{Domain, World};
use sph_probes::ProbeScene;

/// Particles in an open box around the unit square or cube, without walls, gravity or lists.
pub fn world<const D: usize>(free: Store<D>, spacing: f64) -> World<D> {
    World {
        free,
        walls: Default::default(),
        lists: Default::default(),
        domain: Domain::open(Vect::repeat(-1.0), Vect::repeat(2.0)),
        kernel: wendland_c2().sampler(D, 2.0 * spacing),
        spacing,
        skin: 0.1,
        gravity: Vect::zeros(),
        steady_gravity: Vect::zeros(),
        driving: Vect::zeros(),
        time: 0.0,
        dt: 1.0,
        transported: Vec::new(),
        extent: None,
        communicator: None,
    }
}

/// A scene of phases with these names.
pub fn scene(phases: &[String]) -> ProbeScene<'_> {
    ProbeScene {
        phases,
        ..ProbeScene::default()
    }
}
