//! Instruction counts under Valgrind: the same on every run, whatever else the machine does.
//!
//! `cargo bench -p sph-tests --features instructions --bench instructions`; it needs valgrind and
//! `gungraun-runner` of the same version as the library.

#![allow(
    missing_docs,
    reason = "the macros of gungraun make public items without"
)]

mod setup;

use gungraun::{library_benchmark, library_benchmark_group, main};
use setup::{Sums, WendlandC2, terms_by_name, world};
use sph_neighbours::{Terms, World};

/// 2,025 particles.
const SIDE: usize = 45;

fn alone() -> World<2> {
    setup::one_thread();
    world(SIDE)
}

fn typed() -> (World<2>, WendlandC2, Sums) {
    let world = alone();
    let mut sums = Sums::new(&world);
    let kernel = WendlandC2::from_world(&world);
    // Once before, so that buffers have their size.
    sums.by_type(&world, &kernel);
    (world, kernel, sums)
}

fn named(terms: fn() -> Terms<2>) -> (World<2>, Terms<2>, Sums) {
    let world = alone();
    let mut sums = Sums::new(&world);
    let terms = terms();
    sums.by_name(&world, &terms);
    (world, terms, sums)
}

#[library_benchmark]
#[bench::particles_2025(setup = typed)]
fn sweep_types((world, kernel, mut sums): (World<2>, WendlandC2, Sums)) -> (World<2>, Sums) {
    sums.by_type(&world, &kernel);
    (world, sums)
}

#[library_benchmark]
#[bench::plugins(args = (terms_by_name), setup = named)]
fn sweep_plugins((world, terms, mut sums): (World<2>, Terms<2>, Sums)) -> (World<2>, Sums) {
    sums.by_name(&world, &terms);
    (world, sums)
}

#[library_benchmark]
#[bench::particles_2025(setup = alone)]
fn list_build(mut world: World<2>) -> World<2> {
    world.rebuild_lists().expect("there are positions");
    world
}

library_benchmark_group!(
    name = counts;
    benchmarks = sweep_types, sweep_plugins, list_build
);

main!(library_benchmark_groups = counts);
