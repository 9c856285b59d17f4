//! The cost of the plugin architecture: one interaction sweep of pressure, viscosity and smoother
//! over 20,164 particles, on one thread, with (a) kernel and terms as types in one loop, (b) kernel and terms
//! by name.

mod setup;

use divan::{Bencher, counter::ItemsCount};
use setup::{Sums, WendlandC2, pairs, terms_by_name, world};

const SIDE: usize = 142;

fn main() {
    setup::one_thread();
    both_give_the_same();
    divan::main();
}

#[divan::bench]
fn a_types(bencher: Bencher) {
    let world = world(SIDE);
    let kernel = WendlandC2::from_world(&world);
    let mut sums = Sums::new(&world);
    bencher
        .counter(ItemsCount::new(pairs(&world)))
        .bench_local(|| sums.by_type(&world, &kernel));
}

#[divan::bench]
fn b_plugins(bencher: Bencher) {
    let world = world(SIDE);
    let terms = terms_by_name();
    let mut sums = Sums::new(&world);
    bencher
        .counter(ItemsCount::new(pairs(&world)))
        .bench_local(|| sums.by_name(&world, &terms));
}

/// What is timed must be the same physics.
fn both_give_the_same() {
    let world = world(30);
    let [mut typed, mut named] = [0; 2].map(|_| Sums::new(&world));
    typed.by_type(&world, &WendlandC2::from_world(&world));
    named.by_name(&world, &terms_by_name());
    let norms = typed.acceleration.iter().map(|a| a.norm());
    let largest = norms.fold(0.0, f64::max);
    let pairs = typed.acceleration.iter().zip(&named.acceleration);
    let worst = pairs.map(|(a, b)| (a - b).norm()).fold(0.0, f64::max);
    assert!(worst < 1e-12 * largest, "rounding only: {worst:e}");
    let largest = typed.scalar.iter().map(|s| s.abs()).fold(0.0, f64::max);
    let pairs = typed.scalar.iter().zip(&named.scalar);
    let worst = pairs.map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
    assert!(worst < 1e-12 * largest, "rounding only: {worst:e}");
}
