//! Worlds of particles at known places, and probes by their keys.

use sph_core::{Field, Kind, Registry, Role, Store, Vect};
use sph_kernels::{Kernel, wendland_c2};
use sph_neighbours::{Domain, World};
use sph_probes::{Probe, ProbeEntry, ProbeScene};

/// Gives the particles a column.
pub fn put<const D: usize, K: Kind>(
    free: &mut Store<D>,
    field: Field<K>,
    items: impl IntoIterator<Item = K::Item<D>>,
) {
    free.add(field, Role::State);
    free.put(field, items.into_iter().collect()).unwrap();
}

/// The same of one value.
pub fn fill<const D: usize, K: Kind>(free: &mut Store<D>, field: Field<K>, item: K::Item<D>) {
    let items = vec![item; free.len()];
    put(free, field, items);
}

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

/// The probe of a kind with some keys.
pub fn built<const D: usize>(kind: &str, keys: &str) -> Box<dyn Probe<D>> {
    let registry = Registry::<ProbeEntry>::discovered().unwrap();
    let table = toml::from_str(keys).unwrap();
    registry.find(kind).unwrap().build::<D>(&table).unwrap()
}

/// The same, prepared for a scene of two phases.
pub fn prepared<const D: usize>(kind: &str, keys: &str, phases: [&str; 2]) -> Box<dyn Probe<D>> {
    let mut probe = built(kind, keys);
    probe.prepare(&scene(&phases.map(String::from))).unwrap();
    probe
}

/// Equal to rounding.
#[track_caller]
pub fn near(found: f64, expected: f64) {
    close(found, expected, 1e-12);
}

/// Equal to a tolerance.
#[track_caller]
pub fn close(found: f64, expected: f64, tolerance: f64) {
    let error = (found - expected).abs();
    assert!(error < tolerance, "{found} for {expected}: {error:e}");
}

/// A scene of phases with these names.
pub fn scene(phases: &[String]) -> ProbeScene<'_> {
    ProbeScene {
        phases,
        ..ProbeScene::default()
    }
}
