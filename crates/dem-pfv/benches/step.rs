//! Time of a step and of its parts: a dense packing at rest, and grains that flow.

use dem_pfv::grains::{
    Cloud, ContactLaw, GrainSystem, Grown, HertzMindlin, LinearElastic, Setup, Vector, Wall,
    uniform_radii,
};
use divan::counter::ItemsCount;

fn main() {
    divan::main();
}

const MODULUS: f64 = 15e6;

/// Dense at a porosity of 0.40 in a unit box, about five contacts per grain.
fn packing(grains: usize, law: impl ContactLaw + 'static) -> GrainSystem {
    let radius = 0.38 / (grains as f64).cbrt();
    let radii = uniform_radii(grains, 0.9 * radius, 1.1 * radius, 1);
    let grains = Cloud::new([0.0; 3], [1.0; 3]).grains(&radii, 2600.0, 1);
    let walls = Wall::cuboid([0.0; 3], [1.0; 3]);
    let law_of_growth = LinearElastic::new(MODULUS, 0.5, 0.1);
    let setup = Setup::new(grains.expect("a cloud"), law_of_growth);
    let mut system = GrainSystem::new(setup.walls(walls).damping(0.4)).expect("a cloud");
    let growth = Grown {
        fast: 1.004,
        tolerance: 0.1,
        porosity: Some(0.39),
        ..Grown::default()
    };
    growth.run(&mut system, 0.5, 1_000_000).expect("grown");
    system.set_law(0, Box::new(law)).expect("a law");
    system
}

fn stepping(bencher: divan::Bencher, mut system: GrainSystem) {
    let step = 0.3 * system.critical_step();
    let contacts = system.contacts().count();
    bencher
        .counter(ItemsCount::new(contacts * 100))
        .bench_local(|| {
            for _ in 0..100 {
                system.step(step).expect("a step");
            }
        });
}

#[divan::bench(args = [1_000, 5_000, 20_000], sample_count = 5, sample_size = 1)]
fn linear(bencher: divan::Bencher, grains: usize) {
    stepping(
        bencher,
        packing(grains, LinearElastic::new(MODULUS, 0.5, 0.5)),
    );
}

#[divan::bench(args = [5_000], sample_count = 5, sample_size = 1)]
fn hertz_mindlin(bencher: divan::Bencher, grains: usize) {
    stepping(bencher, packing(grains, HertzMindlin::new(1e9, 0.3, 0.5)));
}

/// Evaluation alone, without lists to make.
#[divan::bench(args = [5_000], sample_count = 5, sample_size = 20)]
fn contacts_alone(bencher: divan::Bencher, grains: usize) {
    let mut system = packing(grains, LinearElastic::new(MODULUS, 0.5, 0.5));
    let contacts = system.contacts().count();
    bencher
        .counter(ItemsCount::new(contacts))
        .bench_local(|| system.evaluate().expect("forces"));
}

/// A shower: lists are made anew every few steps.
#[divan::bench(args = [5_000], sample_count = 5, sample_size = 1)]
fn flowing(bencher: divan::Bencher, grains: usize) {
    let mut system = packing(grains, LinearElastic::new(MODULUS, 0.5, 0.5));
    for (i, velocity) in system.grains.velocity.iter_mut().enumerate() {
        let shake = |k: usize| ((i * 7919 + k * 104_729) % 1000) as f64 / 500.0 - 1.0;
        *velocity = 2.0 * Vector::new(shake(1), shake(2), shake(3));
    }
    stepping(bencher, system);
}
