//! The definitions: γ as an area integral, ∇γ as a line integral.
//!
//! γ = ∫₀^R w(r) A(r) r dr, with A(r) the angle of the directions in which the point at the distance
//! r is in the fluid: exact in angle (the circle is cut by the edges), Gauss–Legendre in r between
//! the knots of the kernel, the vertices and the distances of the edges, graded towards the latter.

use std::f64::consts::TAU;

use crate::gamma::kernels::TestKernel;
use crate::gamma::quadrature::{Gauss, breaks};

/// An edge seen from the point: ends relative to it, fluid on the left.
#[derive(Clone, Copy)]
pub struct Edge {
    ends: [[f64; 2]; 2],
    /// Distance to the line, abscissae of the ends along it.
    a: f64,
    y: [f64; 2],
    tangent: [f64; 2],
}

pub fn edges(loops: &[Vec<[f64; 2]>], point: [f64; 2]) -> Vec<Edge> {
    let mut edges = Vec::new();
    for corners in loops {
        for i in 0..corners.len() {
            let [p, q] = [corners[i], corners[(i + 1) % corners.len()]];
            let ends = [p, q].map(|v| [v[0] - point[0], v[1] - point[1]]);
            let along = [q[0] - p[0], q[1] - p[1]];
            let length = along[0].hypot(along[1]);
            let tangent = along.map(|x| x / length);
            let y = ends.map(|e| e[0] * tangent[0] + e[1] * tangent[1]);
            let near = ends[usize::from(y[0].abs() >= y[1].abs())];
            let a = near[0] * tangent[1] - near[1] * tangent[0];
            edges.push(Edge {
                ends,
                a,
                y,
                tangent,
            });
        }
    }
    edges
}

/// γ for every kernel at once: `kernels` share the breaks of all of them.
pub fn gammas(edges: &[Edge], kernels: &[TestKernel], h: f64) -> Vec<f64> {
    let gauss = Gauss::new(24);
    let knots = kernels.iter().flat_map(|k| &k.shape.breaks);
    let mut inner: Vec<f64> = knots.map(|knot| knot * h).collect();
    let radius = inner.iter().copied().fold(0.0, f64::max);
    for edge in edges {
        inner.extend(edge.ends.iter().map(|e| e[0].hypot(e[1])));
        let distance = edge.a.abs();
        if distance > 1e-14 * h && distance < radius {
            inner.push(distance);
            inner.extend((0..16).map(|k| distance * (1.0 + 0.25f64.powi(k))));
            inner.extend((1..60).map(|k| distance * 2f64.powi(k)));
        }
    }
    let mut gammas = vec![0.0; kernels.len()];
    for bounds in breaks(inner, 0.0, radius).windows(2) {
        gauss.rooted(bounds[0], bounds[1], |r, weight| {
            let measure = weight * fluid_angle(edges, r) * r / (h * h);
            for (gamma, kernel) in gammas.iter_mut().zip(kernels) {
                *gamma += measure * kernel.sigma * (kernel.value)(r / h);
            }
        });
    }
    gammas
}

/// Angle of the arcs of the circle of radius r in the fluid.
fn fluid_angle(edges: &[Edge], r: f64) -> f64 {
    let mut angles = Vec::with_capacity(8);
    for edge in edges {
        if edge.a.abs() >= r {
            continue;
        }
        let half = ((r - edge.a) * (r + edge.a)).sqrt();
        for y in [-half, half] {
            if y >= edge.y[0] && y < edge.y[1] {
                // The foot of the perpendicular is at −a n.
                let [tx, ty] = edge.tangent;
                angles.push((y * ty - edge.a * tx).atan2(y * tx + edge.a * ty));
            }
        }
    }
    if angles.is_empty() {
        return if inside(edges, [r, 0.0]) { TAU } else { 0.0 };
    }
    angles.sort_by(f64::total_cmp);
    let first = angles[0];
    angles.push(first + TAU);
    let arcs = angles.windows(2).filter(|arc| {
        let middle = 0.5 * (arc[0] + arc[1]);
        arc[1] > arc[0] && inside(edges, [r * middle.cos(), r * middle.sin()])
    });
    arcs.map(|arc| arc[1] - arc[0]).sum()
}

/// Even–odd rule.
fn inside(edges: &[Edge], at: [f64; 2]) -> bool {
    let crossed = edges.iter().filter(|edge| {
        let [p, q] = edge.ends.map(|e| [e[0] - at[0], e[1] - at[1]]);
        (p[1] > 0.0) != (q[1] > 0.0)
            && (p[0] * (q[1] - p[1]) - p[1] * (q[0] - p[0]) > 0.0) == (q[1] > p[1])
    });
    crossed.count() % 2 == 1
}

/// h ∫ w dS over a stretch of a line at the distance a, all over h; graded about the foot of the perpendicular.
pub fn on_line(gauss: &Gauss, kernel: &TestKernel, a: f64, [low, high]: [f64; 2]) -> f64 {
    let mut inner = vec![0.0];
    for knot in kernel.shape.breaks.iter().filter(|knot| **knot > a) {
        let half = (knot * knot - a * a).sqrt();
        inner.extend([-half, half]);
    }
    inner.extend((0..60).flat_map(|k| [-1.0, 1.0].map(|s| s * a.max(1e-12) * 2f64.powi(k))));
    let mut sum = 0.0;
    for bounds in breaks(inner, low, high).windows(2) {
        gauss.plain(bounds[0], bounds[1], |y, weight| {
            sum += weight * kernel.sigma * (kernel.value)(a.hypot(y));
        });
    }
    sum
}

/// h∇γ = h Σ n ∫ w dS.
pub fn gradient(edges: &[Edge], kernel: &TestKernel, h: f64) -> [f64; 2] {
    let gauss = Gauss::new(24);
    let mut total = [0.0; 2];
    for edge in edges {
        let sum = on_line(&gauss, kernel, edge.a.abs() / h, edge.y.map(|y| y / h));
        total[0] -= sum * edge.tangent[1];
        total[1] += sum * edge.tangent[0];
    }
    total
}

#[test]
fn reference_agrees_with_the_half_plane_and_the_quarter_plane() {
    let kernels = crate::gamma::kernels::all();
    let square = vec![vec![[0.0, 0.0], [9.0, 0.0], [9.0, 9.0], [0.0, 9.0]]];
    let expected = [([4.5, 0.0], 0.5), ([0.0, 0.0], 0.25), ([4.5, 4.5], 1.0)];
    for (point, gamma) in expected {
        for value in gammas(&edges(&square, point), &kernels, 1.0) {
            crate::close(value, gamma, 1e-14, point);
        }
    }
}
