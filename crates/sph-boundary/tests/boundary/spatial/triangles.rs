//! Single triangles against published numbers and quadrature.

use sph_kernels::{Kernel, PiecewisePolynomial};
use std::f64::consts::PI;

use super::{TOLERANCE, assert_within, kernels, quadrature};
use crate::close;
use crate::random::Random;
use crate::vector::{Vector, cross, dot, minus, normal, plus, unit};

/// The integrals over a triangle, in polar coordinates about the foot of the point (the origin).
pub fn reference(shape: &PiecewisePolynomial, t: [Vector; 3], n: Vector) -> [f64; 2] {
    let sigma = shape.normalisation(3);
    let height = -dot(t[0], n);
    let depth = height.abs();
    let foot = n.map(|n| -height * n);
    // ∫ f q dq and K/q, hence ∫ K/q² dq by parts.
    let radial = |q: f64| {
        let fq = quadrature::between(&mut |q| shape.value(q) * q, &shape.breaks, depth, q);
        let k_over_q = |q: f64| 4.0 * PI * sigma * shape.integral(2, q, f64::MAX) / q;
        let inverse = k_over_q(depth) - k_over_q(q) - 4.0 * PI * sigma * fq;
        [sigma * fq, height * inverse / (4.0 * PI)]
    };
    let mut sum = [0.0; 2];
    for (a, b) in [(t[0], t[1]), (t[1], t[2]), (t[2], t[0])] {
        let tangent = unit(minus(b, a));
        let offset = dot(minus(foot, a), cross(n, tangent));
        let [from, to] = [a, b].map(|x| dot(minus(x, foot), tangent));
        let mut cuts = vec![from, to];
        for knot in &shape.breaks[1..] {
            let reach2 = knot * knot - depth * depth - offset * offset;
            let reach = reach2.max(0.0).sqrt();
            cuts.extend([-reach, reach].into_iter().filter(|y| *y > from && *y < to));
        }
        cuts.sort_by(f64::total_cmp);
        for cut in cuts.windows(2) {
            // y = D tan φ.
            let angles = [cut[0], cut[1]].map(|y| (y / offset).atan());
            let mut at = |phi: f64| {
                let s = offset / phi.cos();
                radial((depth * depth + s * s).sqrt().min(shape.support()))
            };
            let part = quadrature::adaptive(&mut at, angles, 1e-14);
            sum = [sum[0] + part[0], sum[1] + part[1]];
        }
    }
    sum
}

#[test]
fn published_numbers_come_out() {
    let (_, of) = kernels().swap_remove(0);
    let up = [0.0, 0.0, 1.0];
    let seen = |point: Vector, t: [Vector; 3]| of.triangle(t.map(|c| minus(c, point)), up);
    let small = [[-0.25, -0.25, 0.0], [0.25, -0.25, 0.0], [0.0, 0.25, 0.0]];
    let one = seen([0.1, 0.05, 0.5], small);
    let corner = [[0.0; 3], [0.5, 0.0, 0.0], [0.0, 0.5, 0.0]];
    let two = seen([0.5, 0.0, 0.3], corner);
    for (value, published) in [
        (one.kernel, 0.030394451226),
        (one.gamma, 0.024601784094),
        (two.kernel, 0.033275280825),
        (two.gamma, 0.028906372803),
    ] {
        close(value, published, 3e-11, "published");
    }
    let below = seen([0.1, 0.05, -0.5], small);
    close(below.gamma, -one.gamma, 1e-10, "γ below");
    close(below.kernel, one.kernel, 1e-10, "∇γ below");
}

#[test]
fn random_triangles_are_as_by_quadrature() {
    for (kernel, of) in kernels() {
        let shape = kernel.shape();
        let mut random = Random(7);
        let mut worst: f64 = 0.0;
        for i in 0..60 {
            let size = [0.3, 1.0, 4.0][i % 3];
            let near = random.vector(0.6 * shape.support());
            let t = [0; 3].map(|_| plus(near, 1.0, random.vector(size)));
            let n = normal(t);
            let exact = reference(shape, t, n);
            let value = of.triangle(t, n);
            let height = -dot(t[0], n);
            let edges = (0..3).map(|i| [t[(i + 1) % 3], t[(i + 2) % 3]]);
            let same = of.polygon(height, n, edges);
            for x in [value, same] {
                worst = worst.max((x.kernel - exact[0]).abs());
                worst = worst.max((x.gamma - exact[1]).abs());
            }
        }
        assert_within(&kernel, worst, TOLERANCE);
    }
}

#[test]
fn moments_are_those_of_many_small_triangles() {
    const PARTS: usize = 40;
    for (kernel, of) in kernels() {
        let mut random = Random(11);
        let (mut worst, mut largest): (f64, f64) = (0.0, 0.0);
        for i in 0..12 {
            let near = random.vector(0.5 * kernel.support());
            let t = [0; 3].map(|_| plus(near, 1.0, random.vector([1.0, 3.0][i % 2])));
            let n = normal(t);
            let foot = n.map(|x| dot(t[0], n) * x);
            let [u, v] = [1, 2].map(|k| minus(t[k], t[0]).map(|x| x / PARTS as f64));
            let at = |i: usize, j: usize| plus(plus(t[0], i as f64, u), j as f64, v);
            let mut sum = [0.0; 3];
            let mut add = |[a, b, c]: [Vector; 3]| {
                let centre = plus(plus(a, 1.0, b), 1.0, c).map(|x| x / 3.0);
                sum = plus(sum, of.triangle([a, b, c], n).kernel, minus(centre, foot));
            };
            for (i, j) in (0..PARTS).flat_map(|i| (0..PARTS - i).map(move |j| (i, j))) {
                add([at(i, j), at(i + 1, j), at(i, j + 1)]);
                if i + j + 1 < PARTS {
                    add([at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)]);
                }
            }
            let whole = of.triangle(t, n);
            let error = minus(whole.moment, sum);
            worst = worst.max(dot(error, error).sqrt());
            largest = largest.max(whole.kernel);
        }
        // The sum itself is good to (1/40)² of a triangle.
        assert_within(&kernel, worst / largest, 4e-4);
    }
}

#[test]
fn lengths_scale_with_h() {
    for kernel in sph_kernels::builtin() {
        let of = |h| sph_boundary::Renormalisation3d::new(kernel.shape(), h).expect("a kernel");
        let t = [[0.2, 0.1, -0.4], [1.1, 0.3, -0.5], [0.1, 0.9, -0.3]];
        let n = normal(t);
        let one = of(1.0).triangle(t, n);
        let small = of(1e-3).triangle(t.map(|c| c.map(|x| 1e-3 * x)), n);
        close(one.gamma, small.gamma, 1e-13, "γ");
        close(one.kernel, 1e-3 * small.kernel, 1e-13, "∇γ");
    }
}
