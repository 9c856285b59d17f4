//! Grains and pore flow together, against closed forms, theory and the source's acceptances.

mod determinism;
mod edges;
mod flow;
mod limit;
mod oedometer;
mod refusals;
mod suspension;

use dem_pfv::coupled::FlowSetup;
use dem_pfv::grains::{ContactLaw, Grain, LinearElastic, Setup, Wall};

const BOX200: &str = include_str!("../../packings/box200.txt");
/// Grown by `examples/pack.rs 1000 1e4 1 1.22`.
const GROWN1000: &str = include_str!("../../packings/grown1000.txt");
const BOX1000: &str = include_str!("../../packings/box1000_mono.txt");
/// Micro modulus E of the thesis, Pa.
const MODULUS: f64 = 15e6;
const DENSITY: f64 = 2600.0;

/// Spheres of a file in a unit box.
fn packing(text: &str) -> Vec<Grain> {
    let lines = text.lines().filter(|l| !l.starts_with('#'));
    let grain = |line: &str| {
        let numbers: Vec<f64> = line
            .split_whitespace()
            .map(|w| w.parse().expect("a number"))
            .collect();
        Grain::new([numbers[0], numbers[1], numbers[2]], numbers[3], DENSITY)
    };
    lines.map(grain).collect()
}

/// Friction of 30 degrees between grains, a = 0.5, smooth walls: the thesis' samples.
fn laws(modulus: f64) -> [LinearElastic; 2] {
    let friction = 30_f64.to_radians().tan();
    [
        LinearElastic::new(modulus, 0.5, friction),
        LinearElastic::new(modulus, 0.0, 0.0),
    ]
}

/// The same setup with walls to which fluid sticks.
fn sticking(mut setup: FlowSetup) -> FlowSetup {
    for side in &mut setup.sides {
        side.sticks = true;
    }
    setup
}

/// Grains in the unit box.
fn boxed(grains: Vec<Grain>, modulus: f64) -> Setup {
    let [between, at_walls] = laws(modulus);
    let walls = Wall::cuboid([0.0; 3], [1.0; 3]).map(|w| w.with_law(1));
    Setup::new(grains, between).law(at_walls).walls(walls)
}

fn box_of_laws(modulus: f64) -> Vec<Box<dyn ContactLaw>> {
    laws(modulus)
        .map(|l| Box::new(l) as Box<dyn ContactLaw>)
        .into()
}
