//! Worlds of particles: a lattice or a disordered cloud in a periodic box.

use sph_core::{Role, Scalar, Store, Vect, fields};
use sph_kernels::{Kernel, wendland_c2};
use sph_neighbours::{Domain, World};

/// A world without walls; density 1, mass and volume of a lattice cell, everything else zero.
pub fn world<const D: usize>(
    positions: Vec<Vect<D>>,
    domain: Domain<D>,
    spacing: f64,
    ratio: f64,
) -> World<D> {
    let mut free = Store::new(positions.len());
    let vectors = [fields::POSITION, fields::VELOCITY, fields::ACCELERATION];
    let scalars = [fields::MASS, fields::DENSITY, fields::VOLUME];
    vectors
        .iter()
        .for_each(|field| free.add(*field, Role::State));
    scalars
        .iter()
        .for_each(|field| free.add(*field, Role::State));
    free.add(fields::MEAN_ACCELERATION, Role::State);
    free.add(fields::PRESSURE, Role::State);
    free.add(fields::DENSITY_CONSTANT, Role::State);
    let cell = spacing.powi(D as i32);
    *free.get_mut(fields::POSITION).unwrap() = positions;
    free.get_mut(fields::MASS).unwrap().fill(cell);
    free.get_mut(fields::DENSITY).unwrap().fill(1.0);
    free.get_mut(fields::VOLUME).unwrap().fill(cell);
    let mut world = World {
        free,
        walls: Default::default(),
        lists: Default::default(),
        domain,
        kernel: wendland_c2().sampler(D, ratio * spacing),
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
    };
    world.rebuild_lists().unwrap();
    world
}

/// The unit box, periodic along all axes.
pub fn periodic<const D: usize>() -> Domain<D> {
    Domain {
        lower: Vect::zeros(),
        upper: Vect::repeat(1.0),
        periodic: [true; D],
    }
}

/// A domain without periods, far larger than the unit box.
pub fn open<const D: usize>() -> Domain<D> {
    Domain::open(Vect::repeat(-9.0), Vect::repeat(9.0))
}

/// n^D particles at the middles of the cells of the unit box.
pub fn lattice<const D: usize>(n: usize) -> Vec<Vect<D>> {
    let index = |k: usize, axis: usize| (k / n.pow(axis as u32)) % n;
    let place = |k: usize| Vect::from_fn(|axis, _| (index(k, axis) as f64 + 0.5) / n as f64);
    (0..n.pow(D as u32)).map(place).collect()
}

/// 1 and −1 in turns at the places of a lattice of n² particles.
pub fn chequer(n: usize) -> impl Fn(&Vect<2>) -> f64 {
    move |x| {
        let index = [0, 1].map(|k| (x[k] * n as f64).floor() as i64);
        1.0 - 2.0 * ((index[0] + index[1]).rem_euclid(2)) as f64
    }
}

/// A lattice shaken by up to `share` of its spacing along every axis.
pub fn disorder<const D: usize>(n: usize, share: f64, seed: u64) -> Vec<Vect<D>> {
    let mut random = Random::new(seed);
    let mut places = lattice::<D>(n);
    for x in &mut places {
        *x += Vect::from_fn(|_, _| random.between(-share, share)) / n as f64;
    }
    places
}

/// Sets a scalar from the position.
pub fn set<const D: usize>(
    world: &mut World<D>,
    field: sph_core::Field<Scalar>,
    mut of: impl FnMut(&Vect<D>) -> f64,
) {
    let positions = world.free.get(fields::POSITION).unwrap();
    let values: Vec<f64> = positions.iter().map(&mut of).collect();
    *world.free.get_mut(field).unwrap() = values;
}

/// Sets the phase from the position.
pub fn set_phase<const D: usize>(world: &mut World<D>, of: impl Fn(&Vect<D>) -> u32) {
    world.free.add(fields::PHASE, Role::State);
    let positions = world.free.get(fields::POSITION).unwrap();
    let phases = positions.iter().map(of).collect();
    *world.free.get_mut(fields::PHASE).unwrap() = phases;
}

/// Sets the velocity from the position.
pub fn set_velocity<const D: usize>(world: &mut World<D>, mut of: impl FnMut(&Vect<D>) -> Vect<D>) {
    let positions = world.free.get(fields::POSITION).unwrap();
    let values: Vec<Vect<D>> = positions.iter().map(&mut of).collect();
    *world.free.get_mut(fields::VELOCITY).unwrap() = values;
}

/// The largest length.
pub fn longest<const D: usize>(vectors: &[Vect<D>]) -> f64 {
    vectors.iter().map(|v| v.norm()).fold(0.0, f64::max)
}

/// The largest size.
pub fn largest(values: &[f64]) -> f64 {
    values.iter().fold(0.0, |m, v| m.max(v.abs()))
}

/// The particle nearest to a place.
pub fn at<const D: usize>(world: &World<D>, place: Vect<D>) -> usize {
    let positions = world.free.get(fields::POSITION).unwrap().iter();
    let distance = |x: &Vect<D>| (x - place).norm();
    let nearest = positions
        .enumerate()
        .min_by(|a, b| distance(a.1).total_cmp(&distance(b.1)));
    nearest.expect("a particle").0
}

/// Numbers in [0, 1) that are the same at every run.
pub struct Random(u64);

impl Random {
    pub fn new(seed: u64) -> Self {
        Random(seed.wrapping_mul(0x9E37_79B9_7F4A_7C15) | 1)
    }

    pub fn next(&mut self) -> f64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        (self.0 >> 11) as f64 / (1u64 << 53) as f64
    }

    pub fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.next()
    }
}
