//! What the plugin architecture costs: one interaction sweep of pressure, viscosity and smoother
//! over 20,164 particles, on one thread, with (a) kernel and terms as types, (b) kernel and terms
//! by name, fused as the solver does it, (c) the same unfused.

mod setup;

use divan::{Bencher, counter::ItemsCount};
use setup::{Sums, WendlandC2, fused_terms_by_name, pairs, terms_by_name, world};

const SIDE: usize = 142;

fn main() {
    setup::one_thread();
    all_three_give_the_same();
    divan::main();
}

#[divan::bench]
fn a_types(bencher: Bencher) {
    let world = world(SIDE);
    let kernel = WendlandC2::of(&world);
    let mut sums = Sums::of(&world);
    bencher
        .counter(ItemsCount::new(pairs(&world)))
        .bench_local(|| sums.by_type(&world, &kernel));
}

#[divan::bench]
fn b_plugins_fused(bencher: Bencher) {
    let world = world(SIDE);
    let terms = fused_terms_by_name();
    let mut sums = Sums::of(&world);
    bencher
        .counter(ItemsCount::new(pairs(&world)))
        .bench_local(|| sums.by_name(&world, &terms));
}

#[divan::bench]
fn c_plugins_unfused(bencher: Bencher) {
    let world = world(SIDE);
    let terms = terms_by_name();
    let mut sums = Sums::of(&world);
    bencher
        .counter(ItemsCount::new(pairs(&world)))
        .bench_local(|| sums.by_name(&world, &terms));
}

/// What is timed must be the same physics.
fn all_three_give_the_same() {
    let world = world(30);
    let [mut typed, mut fused, mut unfused] = [0; 3].map(|_| Sums::of(&world));
    typed.by_type(&world, &WendlandC2::of(&world));
    fused.by_name(&world, &fused_terms_by_name());
    unfused.by_name(&world, &terms_by_name());
    for other in [&fused, &unfused] {
        let largest = typed
            .acceleration
            .iter()
            .map(|a| a.norm())
            .fold(0.0, f64::max);
        let pairs = typed.acceleration.iter().zip(&other.acceleration);
        let worst = pairs.map(|(a, b)| (a - b).norm()).fold(0.0, f64::max);
        assert!(worst < 1e-12 * largest, "rounding only: {worst:e}");
        let largest = typed.scalar.iter().map(|s| s.abs()).fold(0.0, f64::max);
        let pairs = typed.scalar.iter().zip(&other.scalar);
        let worst = pairs.map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        assert!(worst < 1e-12 * largest, "rounding only: {worst:e}");
    }
}
