//! Boxes against volume quadrature, faceted balls against balls.

use std::f64::consts::PI;

use sph_kernels::{Kernel, PiecewisePolynomial};

use super::solid::Solid;
use super::{assert_within, kernels, quadrature};
use crate::vector::{Vector, dot, minus, plus, turned, unit};

/// ∫ w dV over a box as seen from a point, by Gauss rules on panels of 0.1 h.
fn volume(kernel: &dyn Kernel, sides: [[f64; 2]; 3], point: Vector) -> f64 {
    let w = kernel.sampler(3, 1.0);
    let panels = |[a, b]: [f64; 2], f: &mut dyn FnMut(f64) -> f64| -> f64 {
        let count = ((b - a) / 0.25).ceil();
        let step = (b - a) / count;
        let panel = |i: u32| a + step * f64::from(i);
        let mut f = |x: f64| [f(x)];
        let sum = |i| quadrature::gauss(&mut f, panel(i), panel(i + 1))[0];
        (0..count as u32).map(sum).sum()
    };
    let [x, y, z] = [0, 1, 2].map(|i: usize| sides[i].map(|side| side - point[i]));
    panels(x, &mut |x| {
        panels(y, &mut |y| {
            panels(z, &mut |z| w.at((x * x + y * y + z * z).sqrt()).0)
        })
    })
}

#[test]
fn boxes_are_as_by_volume_quadrature() {
    let sides = [[0.0, 1.5], [0.0, 1.1], [0.0, 0.9]];
    let solid = Solid::mapped(Solid::box_of(sides), |v| turned(v, 0.7));
    let reversed = |(face, _): &(Vec<Vector>, Vector)| face.iter().rev().copied().collect();
    let inverted = Solid::new(solid.0.iter().map(reversed).collect());
    for (kernel, of) in kernels() {
        let mut worst: f64 = 0.0;
        for point in [
            [0.7, 0.5, 0.4],
            [0.1, 0.2, 0.7],
            [-0.3, 0.4, 0.5],
            [1.6, 1.2, 1.1],
        ] {
            let exact = volume(&kernel, sides, point);
            let seen = turned(point, 0.7);
            let sum = solid.at(&of, seen);
            worst = worst.max((sum.gamma() - exact).abs());
            worst = worst.max((solid.at_by_triangles(&of, seen).gamma() - sum.gamma()).abs());
            // The fluid around the box.
            worst = worst.max((inverted.at(&of, seen).gamma() + exact - 1.0).abs());
        }
        assert_within(&kernel, worst, 1e-6);
    }
}

/// γ at the distance d from the centre of a ball: the share of every sphere that is inside.
fn ball(shape: &PiecewisePolynomial, radius: f64, d: f64) -> f64 {
    let share = |r: f64| {
        if r <= radius - d {
            1.0
        } else if r >= radius + d || r <= d - radius {
            0.0
        } else {
            (radius * radius - (d - r) * (d - r)) / (4.0 * d * r)
        }
    };
    let mut cuts = shape.breaks.clone();
    cuts.extend([(radius - d).abs(), radius + d]);
    cuts.sort_by(f64::total_cmp);
    let mut f = |r: f64| shape.value(r) * r * r * share(r);
    4.0 * PI * shape.normalisation(3) * quadrature::between(&mut f, &cuts, 0.0, shape.support())
}

/// A ball of 20 · 4ⁿ triangles with its corners on the sphere.
fn icosphere(radius: f64, n: u32) -> Solid {
    let g = 0.5 * (1.0 + 5f64.sqrt());
    let mut corners = Vec::new();
    for (a, b) in [(1.0, g), (-1.0, g), (1.0, -g), (-1.0, -g)] {
        corners.extend([[0.0, a, b], [a, b, 0.0], [b, 0.0, a]]);
    }
    let mut faces = Vec::new();
    for i in 0..12 {
        for j in i + 1..12 {
            for k in j + 1..12 {
                let t = [corners[i], corners[j], corners[k]];
                let near = |a, b| dot(minus(a, b), minus(a, b)) < 4.1;
                if near(t[0], t[1]) && near(t[1], t[2]) && near(t[2], t[0]) {
                    let n = crate::vector::normal(t);
                    let inward = dot(n, t[0]) < 0.0;
                    faces.push(if inward { t } else { [t[0], t[2], t[1]] });
                }
            }
        }
    }
    for _ in 0..n {
        let quarter = |[a, b, c]: [Vector; 3]| {
            let middle = |a, b| plus(a, 1.0, b).map(|x| 0.5 * x);
            let (ab, bc, ca) = (middle(a, b), middle(b, c), middle(c, a));
            [[a, ab, ca], [b, bc, ab], [c, ca, bc], [ab, bc, ca]]
        };
        let quarters = faces.into_iter().flat_map(quarter);
        faces = quarters
            .map(|t| t.map(|c| unit(c).map(|x| g * x)))
            .collect();
    }
    let on_sphere = |t: [Vector; 3]| t.map(|c| unit(c).map(|x| radius * x)).to_vec();
    Solid::new(faces.into_iter().map(on_sphere).collect())
}

#[test]
fn faceted_balls_converge_with_order_two() {
    let radius = 1.3;
    let solids = [1, 2, 3].map(|n| icosphere(radius, n));
    assert_eq!(solids.each_ref().map(|s| s.0.len()), [80, 320, 1280]);
    for (kernel, of) in kernels() {
        for d in [0.0, 0.8, 1.25, 1.6] {
            let exact = ball(kernel.shape(), radius, d);
            let point = unit([0.3, 0.5, 0.8]).map(|x| d * x);
            let error = |s: &Solid| s.at_by_triangles(&of, point).gamma() - exact;
            let errors = solids.each_ref().map(error);
            let orders = [0, 1].map(|i: usize| (errors[i] / errors[i + 1]).log2());
            let seen = errors.map(|e| e as f32);
            println!("{:15} d = {d:4} {seen:?} {orders:.2?}", kernel.name());
            assert!((orders[1] - 2.0).abs() < 0.25, "{errors:?}");
            assert!(errors[2].abs() < 4e-3);
        }
    }
}
