//! Steps of an assembled scene.

#![allow(
    dead_code,
    reason = "this is a module of several benches, each of which uses a part"
)]

use divan::{Bencher, counter::ItemsCount};
use rayon::ThreadPoolBuilder;
use sph_core::{StepLimit, System};
use sph_particles::setup::Assembled;
use sph_tests::{assembled, scene};

/// What a run does between two outputs.
pub fn advance<const D: usize>(parts: &mut Assembled<D>) {
    parts.flow.evaluate().expect("finite rates");
    let limits = parts.flow.step_limits().expect("all columns");
    let dt = StepLimit::least(&limits).expect("sound always limits").dt;
    parts.flow.world.dt = dt;
    let stepped = parts.integrator.step(&mut parts.flow, dt);
    stepped.expect("a good step");
}

/// Times steps of a scene on one thread, after some: the first ones find cold caches and buffers that still grow.
/// Items are particles.
pub fn measured(bencher: Bencher, text: &str, after: usize) {
    let pool = ThreadPoolBuilder::new().num_threads(1).build();
    let pool = pool.expect("threads");
    let mut parts = pool.install(|| {
        let mut parts: Assembled<2> = assembled(&scene(text, &[]));
        (0..after).for_each(|_| advance(&mut parts));
        parts
    });
    bencher
        .counter(ItemsCount::new(parts.flow.world.free.len()))
        .bench_local(|| pool.install(|| advance(&mut parts)));
}
