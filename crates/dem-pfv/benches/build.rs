//! Time of a triangulation: random spheres in a box, and a lattice, where every decision is a tie.

use dem_pfv::triangulation::{Sphere, Triangulation, Wall};
use sph_core::SplitMix;

fn main() {
    divan::main();
}

fn spheres(n: usize) -> Vec<Sphere> {
    let mut random = SplitMix(1);
    let mut draw = || 0.01 + 0.98 * random.unit();
    let size = 0.2 / (n as f64).cbrt();
    let sphere = |_| Sphere::new([draw(), draw(), draw()], size);
    (0..n).map(sphere).collect()
}

#[divan::bench(args = [5_000, 100_000], sample_count = 3, sample_size = 1)]
fn random(bencher: divan::Bencher, n: usize) {
    let spheres = spheres(n);
    let walls = Wall::cuboid([0.0; 3], [1.0; 3]);
    bencher.bench(|| Triangulation::within(&spheres, &walls).expect("cells"));
}

#[divan::bench(args = [17, 46], sample_count = 3, sample_size = 1)]
fn lattice(bencher: divan::Bencher, side: u32) {
    let step = 1.0 / f64::from(side);
    let at = |i: u32| (f64::from(i) + 0.5) * step;
    let site = |i: u32| [at(i % side), at(i / side % side), at(i / side / side)];
    let spheres: Vec<_> = (0..side.pow(3))
        .map(|i| Sphere::new(site(i), 0.5 * step))
        .collect();
    let walls = Wall::cuboid([0.0; 3], [1.0; 3]);
    bencher.bench(|| Triangulation::within(&spheres, &walls).expect("cells"));
}
