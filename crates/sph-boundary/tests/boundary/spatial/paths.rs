//! γ against the line integral of its own gradient.

use sph_boundary::Renormalisation3d;

use super::solid::Solid;
use super::{assert_within, kernels, quadrature};
use crate::random::Random;
use crate::vector::{Vector, dot, minus, plus, turned};

/// The difference of γ along a straight path less the integral of its gradient.
fn defect(of: &Renormalisation3d, solid: &Solid, from: Vector, to: Vector, via: &[f64]) -> f64 {
    let along = minus(to, from);
    let mut slope = |t: f64| [dot(solid.at(of, plus(from, t, along)).gradient, along)];
    let cuts = [&[0.0], via, &[1.0]].concat();
    let integral = |cut: &[f64]| quadrature::adaptive(&mut slope, [cut[0], cut[1]], 1e-9)[0];
    let sum: f64 = cuts.windows(2).map(integral).sum();
    let [a, b] = [from, to].map(|point| solid.at(of, point).gamma());
    // Outside, γ = 0 is taken for 1.
    let difference = b - a - sum;
    difference - difference.round()
}

/// Paths anywhere, and paths past points of interest at 10⁻⁵.
fn worst(of: &Renormalisation3d, solid: &Solid, features: &[Vector], seed: u64) -> f64 {
    let mut random = Random(seed);
    let mut worst: f64 = 0.0;
    for _ in 0..6 {
        let (from, to) = (random.vector(1.5), random.vector(1.5));
        worst = worst.max(defect(of, solid, from, to, &[]).abs());
    }
    for feature in features {
        let (near, along) = (plus(*feature, 1e-5, random.vector(1.0)), random.vector(0.7));
        let (from, to) = (plus(near, -1.0, along), plus(near, 1.0, along));
        worst = worst.max(defect(of, solid, from, to, &[0.5]).abs());
    }
    worst
}

fn check(faces: Vec<Vec<Vector>>, features: [Vector; 5], angle: f64, seed: u64) {
    let block = Solid::mapped(faces, |v| turned(v, angle));
    let features = features.map(|v| turned(v, angle));
    for (kernel, of) in kernels() {
        assert_within(&kernel, worst(&of, &block, &features, seed), 1e-7);
    }
}

#[test]
fn through_a_bend() {
    // On the re-entrant edge, its end, faces and other edges.
    let features = [
        [0.0, 0.0, 0.0],
        [0.0, 0.0, 1.0],
        [0.3, 0.0, 0.2],
        [1.0, 0.0, 0.5],
        [-1.0, -1.0, -1.0],
    ];
    check(Solid::l_block(1.0), features, 0.4, 5);
}

#[test]
fn through_a_notch() {
    let features = [
        [0.0, 0.0, 0.0],
        [0.5, 0.5, 0.5],
        [0.5, 0.1, 0.5],
        [1.0, 1.0, 1.0],
        [1.0, 0.2, 1.0],
    ];
    check(Solid::notched(1.0), features, 2.0, 9);
}
