//! Whole steps of the dam break after Lobovský et al.: lists, stages, limits, kick, drift.
//!
//! Items are particles × neighbours, so that the throughput is comparable with that of one sweep.

mod running;

use std::fmt::{self, Display};

use divan::{Bencher, counter::ItemsCount};
use rayon::ThreadPoolBuilder;
use sph_particles::setup::Assembled;
use sph_tests::{assembled, shipped};

use running::advance;

/// Spacings of about 20,000 and 80,000 particles, on 1 and 2 threads.
const CASES: [Case; 4] = [
    Case("3 mm", 1),
    Case("3 mm", 2),
    Case("1.5 mm", 1),
    Case("1.5 mm", 2),
];

/// Spacing and threads.
#[derive(Clone, Copy)]
struct Case(&'static str, usize);

impl Display for Case {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} on {}", self.0, self.1)
    }
}

fn main() {
    divan::main();
}

#[divan::bench(args = CASES, sample_count = 50)]
fn step(bencher: Bencher, Case(spacing, threads): Case) {
    let pool = ThreadPoolBuilder::new().num_threads(threads).build();
    let pool = pool.expect("threads");
    let mut parts = pool.install(|| {
        let mut parts = dam_break(spacing);
        // The first steps find cold caches and buffers that still grow.
        (0..20).for_each(|_| advance(&mut parts));
        parts
    });
    let neighbours = parts.flow.world.mean_neighbours();
    let items = neighbours.expect("positions") * parts.flow.world.free.len() as f64;
    bencher
        .counter(ItemsCount::new(items as usize))
        .bench_local(|| pool.install(|| advance(&mut parts)));
}

fn dam_break(spacing: &str) -> Assembled<2> {
    let spacing = format!("numerics.spacing={spacing}");
    assembled(&shipped("dam-break-lobovsky", &[&spacing]))
}
