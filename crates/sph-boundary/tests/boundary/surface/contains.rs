//! Inside and outside against exact answers.

use sph_boundary::{Mesh, PeriodicBox};

use crate::close;
use crate::surface::shapes::*;

/// 10⁴ random points and the lattice points of the mesh, which its rays hit in edges and nodes.
fn check(mesh: &Mesh<3>, low: Point, high: Point, fluid: impl Fn(Point) -> Option<bool>) {
    let mut random = Random(42);
    let mut points: Vec<Point> = (0..10_000).map(|_| random.within(low, high)).collect();
    let nodes: Vec<Point> = mesh.nodes.iter().map(|n| n.position).collect();
    for node in nodes.iter().step_by(nodes.len() / 500 + 1) {
        for other in nodes.iter().step_by(nodes.len() / 20 + 1) {
            points.push([node[0], node[1], other[2] + 0.01]);
        }
    }
    let mut asked = 0;
    for point in points {
        if let Some(expected) = fluid(point) {
            assert_eq!(mesh.contains(point), expected, "{point:?}");
            asked += 1;
        }
    }
    assert!(asked >= 9_900, "asked {asked}");
}

fn in_box(p: Point, low: Point, high: Point) -> bool {
    (0..3).all(|k| p[k] > low[k] && p[k] < high[k])
}

#[test]
fn a_box_with_a_pyramid() {
    let walls = [
        tank([0.0; 3], [6.0, 6.0, 4.0]),
        pyramid([3.0, 3.0], 1.5, 0.0, 2.0),
    ];
    let solid = |p: Point| {
        let reach = 1.5 * (1.0 - p[2] / 2.0);
        (p[0] - 3.0).abs() < reach && (p[1] - 3.0).abs() < reach
    };
    let near_surface = |p: Point| {
        let reach = 1.5 * (1.0 - p[2] / 2.0);
        ((p[0] - 3.0).abs().max((p[1] - 3.0).abs()) - reach).abs() < 1e-9
            || (0..3).any(|k| p[k].abs() < 1e-9 || (p[k] - [6.0, 6.0, 4.0][k]).abs() < 1e-9)
    };
    let fluid =
        |p: Point| (!near_surface(p)).then(|| in_box(p, [0.0; 3], [6.0, 6.0, 4.0]) && !solid(p));
    check(&mesh(&walls, 0.5), [-1.0; 3], [7.0, 7.0, 5.0], fluid);
    let apart = Mesh::<3>::build(&walls, &[0, 1], 0.5, &PeriodicBox::none()).unwrap();
    check(&apart, [-1.0; 3], [7.0, 7.0, 5.0], fluid);
}

#[test]
fn an_icosphere() {
    let ball = icosphere(4, 1.0);
    let faces = ball.triangles.iter();
    let faces: Vec<_> = faces.map(|t| t.map(|c| ball.points[c as usize])).collect();
    // Convex: inside of all planes.
    let height = |p: Point| {
        let over = faces.iter().map(|[a, b, c]| {
            let n = cross(minus(*b, *a), minus(*c, *a));
            dot(minus(p, *a), n) / norm(n)
        });
        over.fold(f64::NEG_INFINITY, f64::max)
    };
    let fluid = |p: Point| match height(p) {
        h if h.abs() < 1e-9 => None,
        h => Some(h > 0.0),
    };
    let around = mesh(std::slice::from_ref(&ball), 0.1);
    check(&around, [-1.2; 3], [1.2; 3], fluid);
    let inside = |p: Point| fluid(p).map(|f| !f);
    check(&mesh(&[ball.reversed()], 0.1), [-1.2; 3], [1.2; 3], inside);
}

#[test]
fn an_l_shaped_prism() {
    let l = [
        [0.0, 0.0],
        [3.0, 0.0],
        [3.0, 1.0],
        [1.0, 1.0],
        [1.0, 2.0],
        [0.0, 2.0],
    ];
    let mut walls = prism("l", &l, [0.0, 1.0], true);
    // A fan from the inner corner.
    let caps = walls.triangles.len() - 8;
    walls.triangles.truncate(caps);
    for [a, b] in [[4, 5], [5, 0], [0, 1], [1, 2]] {
        walls.triangles.extend([[3, b, a], [9, 6 + a, 6 + b]]);
    }
    let fluid = |p: Point| {
        let on = p.iter().any(|q| (q - q.round()).abs() < 1e-9);
        let solid = in_box(p, [0.0; 3], [3.0, 1.0, 1.0]) || in_box(p, [0.0; 3], [1.0, 2.0, 1.0]);
        (!on).then_some(!solid)
    };
    let mesh = mesh(&[walls], 0.25);
    assert_eq!(mesh.faces.len(), 8);
    let measures = mesh.elements.iter().map(|t| t.measure);
    measures.for_each(|area| close(area, 0.03125, 1e-15, "a lattice"));
    close(theta_at(&mesh, [1.0; 3])[0], 0.625, 1e-14, "θ");
    check(&mesh, [-0.5; 3], [3.5, 2.5, 1.5], fluid);
}

#[test]
fn a_periodic_pipe() {
    let ring = polygon(24, 1.0);
    let apothem = (std::f64::consts::PI / 24.0).cos();
    let inside = |[x, y, _]: Point| {
        let facet = std::f64::consts::TAU / 24.0;
        let angle = y.atan2(x).rem_euclid(facet) - 0.5 * facet;
        let height = x.hypot(y) * angle.cos() - apothem;
        (height.abs() > 1e-9).then_some(height < 0.0)
    };
    let pipe = prism("pipe", &ring, [0.0, 2.0], false).reversed();
    let domain = periodic([-1.5, -1.5, 0.0], [1.5, 1.5, 2.0], [false, false, true]);
    let along_z = mesh_in(std::slice::from_ref(&pipe), 0.25, &domain);
    // All axes periodic: the box is all there is.
    let domain = periodic([-1.5, -1.5, 0.0], [1.5, 1.5, 2.0], [true; 3]);
    let all = mesh_in(&[pipe], 0.25, &domain);
    for mesh in [along_z, all] {
        check(&mesh, [-1.4, -1.4, -0.5], [1.4, 1.4, 2.5], inside);
    }
}
