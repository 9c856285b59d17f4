//! What the guard costs: a step as it is taken, what is asked of its state, and the copy to fall back on.
//!
//! `step` contains one question of two (the positions); `guard` asks both, `snapshot` copies.

mod running;

use std::fmt::{self, Display};

use divan::Bencher;
use rayon::ThreadPoolBuilder;
use sph_solver::Snapshot;
use sph_solver::step::guard;
use sph_tests::{assembled, shipped};

use running::advance;

/// Scene, spacing, dimension, threads.
#[derive(Clone, Copy)]
struct Case(&'static str, &'static str, usize, usize);

const CASES: [Case; 4] = [
    Case("dam-break-lobovsky", "3 mm", 2, 1),
    Case("dam-break-lobovsky", "3 mm", 2, 2),
    Case("dam-break-spheric2", "40 mm", 3, 1),
    Case("dam-break-spheric2", "40 mm", 3, 2),
];

impl Display for Case {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}D on {}", self.2, self.3)
    }
}

/// What is timed.
#[derive(Clone, Copy, PartialEq)]
enum What {
    Step,
    Guard,
    Snapshot,
}

fn main() {
    divan::main();
}

#[divan::bench(args = CASES, sample_count = 50)]
fn step(bencher: Bencher, case: Case) {
    timed(bencher, case, What::Step);
}

#[divan::bench(args = CASES, sample_count = 50)]
fn guard(bencher: Bencher, case: Case) {
    timed(bencher, case, What::Guard);
}

#[divan::bench(args = CASES, sample_count = 50)]
fn snapshot(bencher: Bencher, case: Case) {
    timed(bencher, case, What::Snapshot);
}

fn timed(bencher: Bencher, case: Case, what: What) {
    match case.2 {
        3 => timed_in::<3>(bencher, case, what),
        _ => timed_in::<2>(bencher, case, what),
    }
}

fn timed_in<const D: usize>(bencher: Bencher, case: Case, what: What) {
    let Case(scene, spacing, _, threads) = case;
    let pool = ThreadPoolBuilder::new().num_threads(threads).build();
    let pool = pool.expect("threads");
    let scene = shipped(scene, &[&format!("numerics.spacing={spacing}")]);
    let bounds = scene.numerics.density_bounds;
    let mut parts = pool.install(|| {
        let mut parts = assembled::<D>(&scene);
        (0..10).for_each(|_| advance(&mut parts));
        parts
    });
    let mut kept = Snapshot::default();
    bencher.bench_local(|| {
        pool.install(|| match what {
            What::Step => advance(&mut parts),
            What::Guard => {
                let (world, laws) = (&parts.flow.world, &parts.flow.laws);
                guard::positions(world).expect("places within the domain");
                guard::rates(world, laws, bounds).expect("a good state");
            }
            What::Snapshot => kept.take(&parts.flow).expect("all columns"),
        });
    });
}
