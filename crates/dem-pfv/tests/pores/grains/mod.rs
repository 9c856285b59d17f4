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

use dem_pfv::grains::{Grain, GrainSystem, LinearElastic, Vector};

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

#[track_caller]
fn close(value: f64, expected: f64, tolerance: f64) {
    assert!(
        (value - expected).abs() <= tolerance,
        "{value} is not {expected} within {tolerance:e}"
    );
}
