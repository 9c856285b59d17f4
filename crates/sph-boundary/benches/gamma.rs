//! Cost of γ and ∇γ per pair of a point and a segment or a triangle, and per edge of a polygon.

use divan::{Bencher, black_box, counter::ItemsCount};
use sph_boundary::{
    ElementTree, Mesh, PeriodicBox, Polyline, Renormalisation2d, Renormalisation3d,
};
use sph_kernels::PolynomialKernel;

fn main() {
    divan::main();
}

const KERNELS: [fn() -> PolynomialKernel; 4] = [
    sph_kernels::wendland_c2,
    sph_kernels::wendland_c6,
    sph_kernels::cubic_spline,
    sph_kernels::quintic_spline,
];

/// A floor of segments of h/2 and points at all heights above it.
#[divan::bench(args = [0, 1, 2, 3])]
fn segment(bencher: Bencher, kernel: usize) {
    let renormalisation = Renormalisation2d::new(KERNELS[kernel]().shape(), 1.0).unwrap();
    let radius = renormalisation.kernel_radius();
    let mut pairs = Vec::new();
    for i in 0..40 {
        let (x, y) = (0.013 * f64::from(i), (f64::from(i) + 0.5) / 40.0 * radius);
        let half = (radius * radius - y * y).sqrt();
        for s in -10..10 {
            let start = 0.5 * f64::from(s) - x;
            if start + 0.5 > -half && start < half {
                pairs.push(([start, -y], [start + 0.5, -y]));
            }
        }
    }
    bencher.counter(ItemsCount::new(pairs.len())).bench(|| {
        let mut sum = 0.0;
        for (start, end) in black_box(&pairs) {
            let integral = renormalisation.segment(*start, *end, [0.0, 1.0]);
            sum += integral.gamma + integral.kernel;
        }
        sum
    });
}

fn tank() -> (Mesh<2>, Renormalisation2d, ElementTree<2>) {
    let square = vec![[0.0, 0.0], [100.0, 0.0], [100.0, 100.0], [0.0, 100.0]];
    let line = Polyline::closed("tank", square);
    let mesh = Mesh::<2>::build(&[line], 0.5, &PeriodicBox::none()).unwrap();
    let renormalisation = Renormalisation2d::new(sph_kernels::wendland_c2().shape(), 1.0).unwrap();
    let tree = ElementTree::build(&mesh, renormalisation.kernel_radius());
    (mesh, renormalisation, tree)
}

/// A thousand points at the distance given from the floor of a tank, search included.
#[divan::bench(args = [0.1, 1.0, 1.9, 50.0])]
fn points(bencher: Bencher, height: f64) {
    let (mesh, renormalisation, tree) = tank();
    bencher.counter(ItemsCount::new(1000usize)).bench(|| {
        let points = (0..1000).map(|i| [5.0 + 0.09 * f64::from(i), height]);
        points
            .map(|point| renormalisation.at(black_box(point), &mesh, &tree).gamma())
            .sum::<f64>()
    });
}

/// Building the tree over 800 segments.
#[divan::bench]
fn tree(bencher: Bencher) {
    let (mesh, ..) = tank();
    bencher.bench(|| ElementTree::build(black_box(&mesh), 2.0));
}

const UP: [f64; 3] = [0.0, 0.0, 1.0];

fn renormalisation(kernel: usize) -> Renormalisation3d {
    Renormalisation3d::new(KERNELS[kernel]().shape(), 1.0).expect("a kernel")
}

/// Triangles with legs h/2 of a plane, seen from points 1/4 to 4 legs above it, within reach.
fn pairs(of: &Renormalisation3d) -> Vec<[[f64; 3]; 3]> {
    let leg = 0.5;
    let mut pairs = Vec::new();
    for k in 0..16 {
        let z = -leg * (0.25 + 0.25 * f64::from(k));
        let (x, y) = (0.031 * f64::from(k), 0.017 * f64::from(k));
        for i in -8..8 {
            for j in -8..8 {
                let (x, y) = (leg * f64::from(i) - x, leg * f64::from(j) - y);
                let corner = |i: f64, j: f64| [x + leg * i, y + leg * j, z];
                let lower = [corner(0.0, 0.0), corner(1.0, 0.0), corner(1.0, 1.0)];
                let upper = [corner(0.0, 0.0), corner(1.0, 1.0), corner(0.0, 1.0)];
                for corners in [lower, upper] {
                    let r2 = |c: [f64; 3]| c.iter().map(|x| x * x).sum::<f64>();
                    if corners.iter().any(|c| r2(*c) < of.kernel_radius().powi(2)) {
                        pairs.push(corners);
                    }
                }
            }
        }
    }
    pairs
}

/// Closed form.
#[divan::bench(args = [0, 1, 2, 3])]
fn triangle(bencher: Bencher, kernel: usize) {
    let of = renormalisation(kernel);
    let pairs = pairs(&of);
    bencher.counter(ItemsCount::new(pairs.len())).bench(|| {
        let sum = |sum: f64, corners: &[[f64; 3]; 3]| {
            let integral = of.triangle(*corners, UP);
            sum + integral.gamma + integral.kernel
        };
        black_box(&pairs).iter().fold(0.0, sum)
    });
}

/// Per edge of a polygon of a thousand edges around the support.
#[divan::bench]
fn far_edge(bencher: Bencher) {
    let of = renormalisation(0);
    let at = |i: u32| {
        let (y, x) = (std::f64::consts::TAU * f64::from(i % 1000) / 1000.0).sin_cos();
        [20.0 * x, 30.0 * y, -0.7]
    };
    let edges: Vec<_> = (0..1000).map(|i| [at(i), at(i + 1)]).collect();
    bencher
        .counter(ItemsCount::new(edges.len()))
        .bench(|| of.polygon(0.7, UP, black_box(&edges).iter().copied()));
}
