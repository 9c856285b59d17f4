//! Planes, half-planes, holes and cuts.

use std::f64::consts::PI;

use sph_boundary::GammaSum;
use sph_kernels::PiecewisePolynomial;

use super::{TOLERANCE, assert_within, kernels, quadrature};
use crate::close;
use crate::random::Random;
use crate::vector::{Vector, edges, minus, plus};

const UP: Vector = [0.0, 0.0, 1.0];

/// Height, h|∇γ| and γ over a plane, Wendland C2, as published.
pub const PLANE: [[f64; 3]; 7] = [
    [0.1, 0.737026343, 0.574565568],
    [0.25, 0.673192978, 0.680934578],
    [0.5, 0.489440918, 0.827583313],
    [0.75, 0.286102295, 0.924097210],
    [1.0, 0.128906250, 0.974609375],
    [1.25, 0.040323257, 0.994372994],
    [1.5, 0.006774902, 0.999397278],
];

/// h|∇γ| at the height t over an infinite plane: 2πσ ∫_t^∞ f q dq.
pub fn slope(shape: &PiecewisePolynomial, t: f64) -> f64 {
    2.0 * PI * shape.normalisation(3) * shape.integral(1, t.abs(), f64::MAX)
}

/// γ − 1/2 at a signed height over an infinite plane.
pub fn excess(shape: &PiecewisePolynomial, height: f64) -> f64 {
    let mut f = |t: f64| slope(shape, t);
    quadrature::between(&mut f, &shape.breaks, 0.0, height.abs()).copysign(height)
}

fn square(half: f64) -> Vec<Vector> {
    let corners = [[-half, -half], [half, -half], [half, half], [-half, half]];
    corners.map(|[x, y]| [x, y, 0.0]).to_vec()
}

#[test]
fn a_large_polygon_is_a_plane() {
    for (kernel, of) in kernels() {
        let shape = kernel.shape();
        let mut worst: f64 = 0.0;
        for half in [1.5 * shape.support(), 1e5] {
            for i in 0..40 {
                let height = 0.03 * f64::from(i) * shape.support();
                let point = [0.3, -0.2, height];
                let wall = square(half);
                let mut sum = GammaSum::<3>::default();
                sum.add(&of.polygon(height, UP, edges(&wall, point)), UP);
                let gamma = 0.5 + excess(shape, height);
                worst = worst.max((sum.gamma() - gamma).abs());
                worst = worst.max((sum.gradient[2] - slope(shape, height)).abs());
            }
        }
        assert_within(&kernel, worst, TOLERANCE);
    }
}

#[test]
fn the_published_table_comes_out() {
    let kernel = sph_kernels::wendland_c2();
    let of = &kernels()[0].1;
    for [d, gradient, gamma] in PLANE {
        let value = of.polygon(d, UP, edges(&square(50.0), [0.0, 0.0, d]));
        close(1.0 - value.gamma, gamma, 1e-9, d);
        close(value.kernel, gradient, 1e-9, d);
        close(0.5 + excess(kernel.shape(), d), gamma, 1e-9, d);
    }
}

#[test]
fn out_of_reach_is_nothing() {
    for (_, of) in kernels() {
        let radius = of.kernel_radius();
        for point in [[0.0, 0.0, 1.001 * radius], [3.0 + 1.5 * radius, 0.0, 0.1]] {
            let value = of.polygon(point[2], UP, edges(&square(3.0), point));
            assert!(value.kernel.abs() < 1e-15 && value.gamma.abs() < 1e-15);
            let far = [[8.0, 0.0, -0.1], [9.0, 0.0, -0.1], [8.0, 1.0, -0.1]];
            assert!(of.triangle(far, UP).kernel.abs() < 1e-15);
        }
    }
}

/// A square with a square hole, as a polygon, and cut into triangles with all cuts included.
#[test]
fn cuts_and_holes_do_not_matter() {
    let (outer, inner) = (square(1.2), square(0.5));
    let mut hole = inner.clone();
    hole.reverse();
    let mut triangles = Vec::new();
    for i in 0..4 {
        let j = (i + 1) % 4;
        triangles.push([outer[i], outer[j], inner[i]]);
        triangles.push([outer[j], inner[j], inner[i]]);
    }
    for (kernel, of) in kernels() {
        let mut random = Random(3);
        let mut worst: f64 = 0.0;
        for i in 0..400 {
            let mut point = plus(random.vector(1.6), 0.1, UP);
            if i % 4 == 0 {
                // Over a corner of the hole, an edge of it and a cut.
                point = plus([0.5, 0.5, 0.0], random.between(-1e-6, 1e-6), point);
            }
            let ring = edges(&outer, point).chain(edges(&hole, point));
            let one = of.polygon(point[2], UP, ring);
            let mut many = [0.0; 2];
            for t in &triangles {
                let part = of.triangle(t.map(|c| minus(c, point)), UP);
                many = [many[0] + part.kernel, many[1] + part.gamma];
            }
            let turns = one.gamma - many[1];
            worst = worst.max((one.kernel - many[0]).abs());
            worst = worst.max((turns - turns.round()).abs());
        }
        assert_within(&kernel, worst, 2e-12);
    }
}
