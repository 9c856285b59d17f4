//! Grains against closed forms, conservation laws and published behaviour.

mod collisions;
mod determinism;
mod energy;
mod friction;
mod meshes;
mod periodic;
mod plugins;
mod refusals;
mod samples;
mod stability;
mod statics;
mod strain;
mod triaxial;

use std::f64::consts::PI;

use dem_pfv::grains::{
    Cloud, Grain, GrainSystem, Grown, LinearElastic, Setup, Vector, Wall, uniform_radii,
};

const RADIUS: f64 = 0.1;
const MODULUS: f64 = 1e6;
/// k = E R between equal spheres and at a wall, N/m.
const STIFFNESS: f64 = MODULUS * RADIUS;
const GRAVITY: f64 = 9.81;

/// Density with which a sphere of [`RADIUS`] weighs 1 kg.
fn kilogram() -> f64 {
    1.0 / (4.0 / 3.0 * PI * RADIUS.powi(3))
}

fn grain(x: f64, y: f64, z: f64) -> Grain {
    Grain::new([x, y, z], RADIUS, kilogram())
}

fn law(ratio: f64, friction: f64, damping: f64) -> LinearElastic {
    LinearElastic {
        damping,
        ..LinearElastic::new(MODULUS, ratio, friction)
    }
}

fn run(system: &mut GrainSystem, step: f64, steps: usize) {
    for _ in 0..steps {
        system.step(step).expect("a step");
    }
}

fn position(system: &GrainSystem, grain: usize) -> Vector {
    system.grains.position[grain]
}

fn velocity(system: &GrainSystem, grain: usize) -> Vector {
    system.grains.velocity[grain]
}

fn spin(system: &GrainSystem, grain: usize) -> Vector {
    system.grains.spin[grain]
}

/// Wall z = 0 with grains above it.
fn floor() -> Wall {
    Wall::new([0.0; 3], [0.0, 0.0, 1.0])
}

/// Two floors that face each other across the origin, so near that a ball of [`RADIUS`] is pressed.
fn jaws() -> [Wall; 2] {
    [1.0, -1.0].map(|up| Wall::new([0.0, 0.0, -0.95 * RADIUS * up], [0.0, 0.0, up]))
}

/// Repeats the box from 0 to an end along all axes.
fn repeated(setup: Setup, end: f64) -> Setup {
    (0..3).fold(setup, |setup, axis| setup.periodic(axis, 0.0, end))
}

/// A random cloud of grains of 2600 kg/m³ in the unit box.
fn cloud(count: usize, [least, most]: [f64; 2], seed: u64) -> Vec<Grain> {
    let radii = uniform_radii(count, least, most, seed);
    let grains = Cloud::new([0.0; 3], [1.0; 3]).grains(&radii, 2600.0, seed);
    grains.expect("a cloud")
}

/// Grains that grew between smooth walls of the unit box; E = 15 MPa, a = 0.5.
fn grown(grains: Vec<Grain>, friction: f64, growth: Grown) -> GrainSystem {
    let law = |ratio, friction| LinearElastic::new(15e6, ratio, friction);
    let walls = Wall::cuboid([0.0; 3], [1.0; 3]).map(|w| w.with_law(1));
    let setup = Setup::new(grains, law(0.5, friction)).law(law(0.0, 0.0));
    let mut system = GrainSystem::new(setup.walls(walls).damping(0.2)).expect("a sample");
    growth.run(&mut system, 0.5, 1_000_000).expect("grown");
    system
}
