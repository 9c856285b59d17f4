//! Grains and pore flow together, against closed forms, theory and the source's acceptances.

mod determinism;
mod edges;
mod flow;
mod limit;
mod oedometer;
mod refusals;
mod suspension;

use dem_pfv::Axis;
use dem_pfv::coupled::{FlowSetup, Fluid, WallBoundary, Wave};
use dem_pfv::grains::{ContactLaw, Grain, GrainSystem, LinearElastic, Setup, Wall};
use dem_pfv::triangulation::Sphere;

use crate::spheres;

/// Grown by `examples/pack.rs 1000 1e4 1 1.22`.
const GROWN1000: &str = include_str!("../../packings/grown1000.txt");
/// Micro modulus E of the thesis, Pa.
const MODULUS: f64 = 15e6;
const DENSITY: f64 = 2600.0;

/// Spheres of a file in a unit box.
fn packing(text: &str) -> Vec<Grain> {
    let grain = |s: Sphere| Grain::new(s.centre.into(), s.radius, DENSITY);
    spheres(text).into_iter().map(grain).collect()
}

/// Friction of 30 degrees between grains, a = 0.5, smooth walls: the thesis' samples.
fn laws() -> [LinearElastic; 2] {
    let friction = 30_f64.to_radians().tan();
    [(0.5, friction), (0.0, 0.0)].map(|(a, friction)| LinearElastic::new(MODULUS, a, friction))
}

/// The same setup with walls to which fluid sticks.
fn sticking(mut setup: FlowSetup) -> FlowSetup {
    for side in &mut setup.sides {
        side.sticks = true;
    }
    setup
}

/// Grains in the unit box.
fn boxed(grains: Vec<Grain>) -> Setup {
    let [between, at_walls] = laws();
    let walls = Wall::cuboid([0.0; 3], [1.0; 3]).map(|w| w.with_law(1));
    Setup::new(grains, between).law(at_walls).walls(walls)
}

/// A packing in the unit box.
fn packed(text: &str) -> GrainSystem {
    GrainSystem::new(boxed(packing(text))).expect("grains")
}

fn boxed_laws() -> Vec<Box<dyn ContactLaw>> {
    laws().map(|l| Box::new(l) as Box<dyn ContactLaw>).into()
}

/// A fluid between a drained floor and a drained top.
fn drained_both_ways(viscosity: f64) -> FlowSetup {
    let setup = FlowSetup::new(Fluid::new(viscosity, 0.0));
    let drained = || WallBoundary::drained(0.0);
    setup.side(4, drained()).side(5, drained())
}

/// A wave along x that stands still, with its crest at zero.
fn wave(half_length: f64, amplitude: f64) -> Wave {
    Wave {
        axis: Axis::X,
        crest: 0.0,
        half_length,
        amplitude,
        ramp: 0.0,
        period: None,
    }
}
