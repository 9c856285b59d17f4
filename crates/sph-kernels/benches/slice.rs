//! Time per element of every built-in kernel on slices of squared distances.
//!
//! `cargo bench -p sph-kernels`; the "items" column is the number of elements per second.

use divan::counter::ItemsCount;
use divan::{Bencher, black_box};
use sph_kernels::{Kernel, Sampler, by_name};

const NAMES: [&str; 6] = [
    "wendland-c2",
    "wendland-c4",
    "wendland-c6",
    "cubic-spline",
    "quartic-spline",
    "quintic-spline",
];

/// A neighbour list in the plane, and a batch of them.
const LENGTHS: [usize; 2] = [46, 1024];

fn main() {
    divan::main();
}

/// Squared distances spread evenly over a little more than the support, in shuffled order.
fn distances(support: f64, length: usize) -> Vec<f64> {
    let place = |i: usize| (i * 389 % length) as f64 / length as f64;
    (0..length)
        .map(|i| 1.1 * support * support * place(i))
        .collect()
}

fn bench(bencher: Bencher, name: &str, length: usize, run: fn(&dyn Sampler, &[f64], &mut [f64])) {
    let kernel = by_name(name).expect("built in");
    let sampler = kernel.sampler(2, 1.0);
    let r2 = distances(kernel.support(), length);
    let mut out = vec![0.0; 2 * length];
    bencher
        .counter(ItemsCount::new(length))
        .bench_local(|| run(&*sampler, black_box(&r2), black_box(&mut out)));
}

#[divan::bench(args = NAMES, consts = LENGTHS)]
fn value<const N: usize>(bencher: Bencher, name: &str) {
    bench(bencher, name, N, |sampler, r2, out| {
        sampler.value(r2, &mut out[..r2.len()])
    });
}

#[divan::bench(args = NAMES, consts = LENGTHS)]
fn gradient_factor<const N: usize>(bencher: Bencher, name: &str) {
    bench(bencher, name, N, |sampler, r2, out| {
        sampler.gradient_factor(r2, &mut out[..r2.len()])
    });
}

#[divan::bench(args = NAMES, consts = LENGTHS)]
fn both<const N: usize>(bencher: Bencher, name: &str) {
    bench(bencher, name, N, |sampler, r2, out| {
        let (w, factor) = out.split_at_mut(r2.len());
        sampler.both(r2, w, factor);
    });
}
