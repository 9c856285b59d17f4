//! A coupled step of a packing of 1000 spheres, and what is done once per mesh.

use dem_pfv::coupled::{CoupledSystem, FlowSetup, Fluid, WallBoundary};
use dem_pfv::grains::{Grain, GrainSystem, LinearElastic, Setup, Wall};

fn main() {
    divan::main();
}

fn system() -> CoupledSystem {
    let lines = include_str!("../tests/packings/box1000_mono.txt").lines();
    let grains = lines.filter(|l| !l.starts_with('#')).map(|line| {
        let mut numbers = line
            .split_whitespace()
            .map(|w| w.parse().expect("a number"));
        let mut next = || numbers.next().expect("x y z r");
        Grain::new([next(), next(), next()], next(), 2600.0)
    });
    let setup = Setup::new(grains.collect(), LinearElastic::new(15e6, 0.5, 0.5));
    let grains = GrainSystem::new(setup.walls(Wall::cuboid([0.0; 3], [1.0; 3]))).expect("grains");
    let mut setup = FlowSetup::new(Fluid::new(125.0, 0.0));
    setup.remeshing.strain = None;
    let setup = setup
        .side(4, WallBoundary::drained(0.0))
        .side(5, WallBoundary::drained(0.0));
    CoupledSystem::new(grains, setup).expect("a system")
}

#[divan::bench]
fn step(bencher: divan::Bencher) {
    let mut system = system();
    bencher.bench_local(|| system.step_unchecked(1e-5).expect("a step"));
}

#[divan::bench]
fn mesh(bencher: divan::Bencher) {
    let mut system = system();
    bencher.bench_local(|| system.remesh().expect("a mesh"));
}
