//! Bodies that touch: what they have in common is no boundary of the fluid.

use std::collections::BTreeSet;
use std::f64::consts::PI;

use sph_boundary::{Mesh, PeriodicBox, Surface};

use crate::close;
use crate::surface::shapes::*;

/// Solid angle between three directions: van Oosterom and Strackee (1983).
fn solid_angle(a: Point, b: Point, c: Point) -> f64 {
    let (na, nb, nc) = (norm(a), norm(b), norm(c));
    let over = dot(a, cross(b, c));
    let under = na * nb * nc + dot(a, b) * nc + dot(b, c) * na + dot(c, a) * nb;
    2.0 * over.abs().atan2(under)
}

/// Every place of the wall is met from both sides: closed, and no two nodes at one place.
fn check_closed(mesh: &Mesh<3>) {
    check_closed_area(mesh);
    close(leak(mesh), 0.0, 1e-12, "leak");
    let positions = mesh.nodes.iter().map(|n| n.position);
    let places: BTreeSet<_> = positions
        .map(|x| x.map(|x| (x * 1e7).round() as i64))
        .collect();
    assert_eq!(places.len(), mesh.nodes.len());
}

fn check_closed_area(mesh: &Mesh<3>) {
    assert!(mesh.free_edges.is_empty());
    let sizes: f64 = mesh.nodes.iter().map(|n| n.size).sum();
    close(
        sizes * mesh.spacing.powi(2),
        area(mesh),
        1e-9 * area(mesh),
        "sizes",
    );
}

#[test]
fn a_pyramid_stands_on_the_floor() {
    let (half, height) = (1.3, 1.7);
    let walls = [
        tank([0.0; 3], [6.0, 6.0, 4.0]),
        pyramid([3.0, 3.2], half, 0.0, height),
    ];
    let mesh = mesh(&walls, 0.25);
    check_closed(&mesh);
    let slant = (half * half + height * height).sqrt();
    let expected = 2.0 * 36.0 + 4.0 * 24.0 - 4.0 * half * half + 4.0 * half * slant;
    close(area(&mesh), expected, 1e-12 * expected, "area");
    let floor = mesh.faces.iter().find(|f| f.normal[2] > 0.999).unwrap();
    assert_eq!(floor.edges.len(), 8, "a square with a square hole");
    assert_eq!(mesh.faces.len(), 6 + 4);
    // At a corner of the base: the half space less the corner of the pyramid.
    let corner = solid_angle([1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [half, half, height]);
    let expected = (2.0 * PI - corner) / (4.0 * PI);
    for (x, y) in [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)] {
        let theta = theta_at(&mesh, [3.0 + x * half, 3.2 + y * half, 0.0]);
        assert_eq!(theta.len(), 1);
        close(theta[0], expected, 1e-14, (x, y));
    }
    // At the tip: all but the pyramid.
    let down = |x: f64, y: f64| [x * half, y * half, -height];
    let cone = 2.0 * solid_angle(down(-1.0, -1.0), down(1.0, -1.0), down(1.0, 1.0));
    let tip = theta_at(&mesh, [3.0, 3.2, height]);
    close(tip[0], 1.0 - cone / (4.0 * PI), 1e-14, "at the tip");
    // Quality: no element far smaller than the others.
    let measures = mesh.elements.iter().map(|t| t.measure);
    let smallest = measures.fold(f64::INFINITY, f64::min);
    assert!(smallest > 0.05 * 0.25 * 0.25, "{smallest} m²");
}

#[test]
fn a_block_in_a_corner_touches_three_walls() {
    let walls = [
        tank([0.0; 3], [4.0; 3]),
        block("block", [0.0; 3], [1.0, 1.5, 2.0]),
    ];
    let mesh = mesh(&walls, 0.5);
    check_closed(&mesh);
    // What the block covers of the walls it shows again on its other sides.
    assert!((area(&mesh) - 96.0).abs() < 1e-11);
    let expected = [
        ([1.0, 1.5, 2.0], 0.875),
        ([1.0, 1.5, 0.0], 0.375),
        ([1.0, 0.0, 2.0], 0.375),
        ([1.0, 0.0, 0.0], 0.125),
        ([1.0, 0.5, 0.0], 0.25),
        ([1.0, 1.0, 2.0], 0.75),
    ];
    for (place, theta) in expected {
        assert_eq!(theta_at(&mesh, place).len(), 1);
        close(theta_at(&mesh, place)[0], theta, 1e-14, place);
    }
    assert!(theta_at(&mesh, [0.0; 3]).is_empty());
    // All lengths are multiples of the spacing: lattice everywhere; the 2 + 4 cells in the middle of three are quartered.
    let of_size = |area: f64| {
        let all = mesh.elements.iter();
        all.filter(|t| (t.measure - area).abs() < 1e-14).count()
    };
    assert_eq!([0.125, 0.0625].map(of_size), [768 - 2 * 6, 4 * 6]);
}

#[test]
fn a_block_in_a_corner_of_two_walls_and_none_of_a_grid() {
    let walls = [
        tank([0.0; 3], [4.0; 3]),
        block("block", [0.0, 1.03, 0.0], [0.97, 2.11, 0.77]),
    ];
    let mesh = mesh(&walls, 0.25);
    check_closed(&mesh);
    let ends = 2.0 * 0.97 * 0.77;
    assert!((area(&mesh) - 96.0 - ends).abs() < 1e-11);
}

#[test]
fn two_blocks_side_by_side_are_one() {
    let walls = [
        block("left", [0.0; 3], [1.0, 1.0, 1.0]),
        block("right", [1.0, 0.25, 0.0], [2.0, 0.75, 1.0]),
        block("top", [0.5, 0.25, 1.0], [1.5, 0.75, 1.3]),
    ];
    let mesh = mesh(&walls, 0.125);
    check_closed(&mesh);
    let single = [6.0, 2.0 * (0.5 + 1.0 + 0.5), 2.0 * (0.5 + 0.3 + 0.15)];
    let common = 2.0 * (0.5 + 2.0 * 0.25);
    assert!((area(&mesh) - (single.iter().sum::<f64>() - common)).abs() < 1e-12);
    // In other groups all remain whole.
    let apart = Mesh::<3>::build(&walls, &[0, 1, 2], 0.125, &PeriodicBox::none()).unwrap();
    assert!((area(&apart) - single.iter().sum::<f64>()).abs() < 1e-12);
    assert!(!apart.contains([0.9, 0.5, 0.5]) && !apart.contains([1.1, 0.5, 0.5]));
    assert!(apart.contains([1.1, 0.1, 0.5]) && mesh.contains([1.1, 0.1, 0.5]));
    assert!(!mesh.contains([0.9, 0.5, 0.5]) && !mesh.contains([1.1, 0.5, 0.5]));
}

#[test]
fn turned_bodies_touch_as_well() {
    // The same, turned out of all axes: planes and corners agree to rounding only.
    let pose = sph_boundary::Pose::turned_about([0.48, 0.64, -0.6], 0.7, [0.3, 0.1, 0.9]);
    let turn = |mut s: Surface| {
        for p in &mut s.points {
            *p = pose.map()(*p);
        }
        s
    };
    let walls = [
        tank([0.0; 3], [6.0, 6.0, 4.0]),
        pyramid([3.0, 3.23], 1.31, 0.0, 1.7),
    ];
    let straight = mesh(&walls, 0.25);
    let turned = mesh(&walls.map(turn), 0.25);
    check_closed(&turned);
    assert!((area(&turned) - area(&straight)).abs() < 1e-11);
    assert_eq!(turned.nodes.len(), straight.nodes.len());
    let walls = [
        block("left", [0.0; 3], [1.0, 1.0, 1.0]),
        block("right", [1.0, 0.25, 0.0], [2.0, 0.75, 1.0]),
    ];
    let turned = mesh(&walls.map(turn), 0.1);
    check_closed(&turned);
    assert!((area(&turned) - 9.0).abs() < 1e-11);
}

#[test]
fn blocks_that_touch_in_an_edge_only() {
    let walls = [
        block("one", [0.0; 3], [1.0; 3]),
        block("two", [1.0, 1.0, 0.0], [2.0, 2.0, 1.0]),
    ];
    let mesh = mesh(&walls, 0.25);
    check_closed(&mesh);
    // Two right angles of fluid along the edge, and half the space above less two eighths.
    assert!((theta_at(&mesh, [1.0, 1.0, 0.5])[0] - 0.5).abs() < 1e-14);
    assert!((theta_at(&mesh, [1.0, 1.0, 1.0])[0] - 0.75).abs() < 1e-14);
}

#[test]
fn walls_drawn_one_by_one_are_joined() {
    // Six sheets, one of them finer than its neighbours.
    let whole = tank([0.0; 3], [2.0; 3]);
    let side = |(side, triangles): (usize, &[[u32; 3]])| Surface {
        name: format!("side {side}"),
        triangles: triangles.to_vec(),
        ..whole.clone()
    };
    let sides = whole.triangles.chunks(2).enumerate();
    let mut walls: Vec<Surface> = sides.map(side).collect();
    let joined = mesh(&walls, 0.5);
    check_closed(&joined);
    let nodes = mesh(std::slice::from_ref(&whole), 0.5).nodes.len();
    assert_eq!(joined.nodes.len(), nodes);
    walls[0] = walls[0].clone().reversed();
    let refused = Mesh::<3>::build(&walls, &[0; 6], 0.5, &PeriodicBox::none());
    let message = refused.unwrap_err().to_string();
    let named = message.starts_with("walls `side 0` and `side ");
    let why = message.contains("put the fluid on opposite sides: reverse");
    assert!(named && why, "{message}");
}

#[test]
fn a_block_across_the_seam_of_a_periodic_floor() {
    let floor = floor([0.0; 2], [4.0, 3.0]);
    let body = block("body", [3.5, 1.0, 0.0], [4.5, 2.0, 1.0]);
    let domain = periodic([0.0; 3], [4.0, 3.0, 2.0], [true, true, false]);
    let mesh = mesh_in(&[floor, body], 0.25, &domain);
    check_closed_area(&mesh);
    assert!((area(&mesh) - (12.0 + 4.0)).abs() < 1e-12);
    assert!(!mesh.contains([0.25, 1.5, 0.5]) && !mesh.contains([3.75, 1.5, 0.5]));
    assert!(mesh.contains([0.75, 1.5, 0.5]) && mesh.contains([0.25, 1.5, 1.5]));
    assert!(!mesh.contains([0.75, 1.5, -0.5]));
}

#[test]
fn a_block_turned_on_another_one() {
    // Their common face is a polygon of up to eight corners, half of them on no other edge.
    let mut smallest = f64::INFINITY;
    for step in 0..90 {
        let angle = 0.07 * f64::from(step);
        let turn = sph_boundary::Pose::turned_about([0.0, 0.0, 1.0], angle, [0.1, 0.2, 0.0]);
        let mut upper = block("upper", [-1.0, -0.7, 1.0], [1.0, 0.8, 2.0]);
        for p in &mut upper.points {
            *p = turn.map()(*p);
        }
        let floor = tank([-3.0, -3.0, 0.0], [3.0, 3.0, 3.0]);
        let lower = block("lower", [-1.0, -1.0, 0.0], [1.0, 0.5, 1.0]);
        let mesh = mesh(&[floor, lower, upper], 0.21);
        check_closed(&mesh);
        let areas = mesh.elements.iter().map(|t| t.measure);
        smallest = areas.fold(smallest, f64::min);
        // Above the common face is no boundary.
        let common = mesh.elements.iter().filter(|t| t.normal[2].abs() > 0.5);
        let common = common.filter(|t| (t.centre[2] - 1.0).abs() < 1e-9);
        let both: f64 = common.map(|t| t.measure * t.normal[2]).sum();
        close(
            both,
            0.0,
            1e-9,
            "as much of one faces up as of the other down",
        );
        assert!(mesh.nodes.iter().all(|n| n.theta > 0.0 && n.theta < 1.0));
    }
    println!("smallest triangle of 90 meshes {smallest:.2e} m²");
}
