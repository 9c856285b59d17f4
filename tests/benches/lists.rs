//! Neighbour lists and kernel sums, per particle, on one thread.

mod setup;

use divan::{Bencher, counter::ItemsCount};
use setup::world;
use sph_neighbours::kernel_sums;

const SIDES: [usize; 2] = [142, 283];

fn main() {
    setup::one_thread();
    divan::main();
}

/// Cell grid and list with its skin, particles already in order.
#[divan::bench(args = SIDES)]
fn build(bencher: Bencher, side: usize) {
    let mut world = world(side);
    bencher
        .counter(ItemsCount::new(world.free.len()))
        .bench_local(|| world.rebuild_lists().expect("there are positions"));
}

/// The density sum, which leaves the list without its skin; the test whether the lists still
/// hold is part of it, as in a step.
#[divan::bench(args = SIDES)]
fn sums(bencher: Bencher, side: usize) {
    let mut world = world(side);
    let mut sums = vec![0.0; world.free.len()];
    bencher
        .counter(ItemsCount::new(world.free.len()))
        .bench_local(|| {
            world.refresh_lists().expect("there are positions");
            kernel_sums(&mut world, &mut sums).expect("there are positions");
        });
}
