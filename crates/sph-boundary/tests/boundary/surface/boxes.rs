//! Boxes, spheres and pipes: the lattice, θ, areas.

use sph_boundary::{Mesh, PeriodicBox, Pose};

use crate::close;
use crate::surface::shapes::*;

#[test]
fn a_tank_gets_the_square_lattice() {
    let mesh = mesh(&[tank([0.0; 3], [4.0, 4.0, 4.0])], 0.5);
    // 8 cells to a side: 9³ − 7³ lattice points on the surface, two triangles to a cell.
    assert_eq!((mesh.nodes.len(), mesh.elements.len()), (386, 768));
    assert_eq!((mesh.faces.len(), mesh.free_edges.len()), (6, 0));
    assert!(mesh.faces.iter().all(|f| f.edges.len() == 4));
    for node in &mesh.nodes {
        assert!(node.position.iter().all(|x| (2.0 * x).fract() == 0.0));
        let sides = node.position.iter().filter(|x| **x == 0.0 || **x == 4.0);
        assert_eq!(node.theta, [0.5, 0.25, 0.125][sides.count() - 1]);
    }
    let measures = mesh.elements.iter().map(|t| t.measure);
    measures.for_each(|area| close(area, 0.125, 1e-15, "half a cell"));
    close(area(&mesh), 96.0, 1e-12, "area");
    assert!(leak(&mesh) < 1e-13);
    let sizes = mesh.nodes.iter().map(|n| n.size);
    close(sizes.sum(), 384.0, 1e-9, "sizes");
    // Inside a face all nodes have the same share.
    let flat = mesh.nodes.iter().filter(|n| n.theta == 0.5);
    assert!(flat.clone().all(|n| (n.size - 1.0).abs() < 1e-14));
    assert_eq!(flat.count(), 6 * 49);
}

#[test]
fn a_block_has_the_rest_of_the_angles() {
    let mesh = mesh(&[block("block", [0.0; 3], [2.0, 1.0, 3.0])], 0.5);
    for node in &mesh.nodes {
        let p = node.position;
        let high = [2.0, 1.0, 3.0];
        let sides = (0..3).filter(|k| p[*k] == 0.0 || p[*k] == high[*k]);
        assert!((node.theta - [0.5, 0.75, 0.875][sides.count() - 1]).abs() < 1e-15);
    }
    assert_eq!(mesh.nodes.len(), 5 * 3 * 7 - 3 * 5);
}

#[test]
fn sides_that_are_no_multiple_are_cut_into_equal_parts() {
    let mesh = mesh(&[tank([0.0; 3], [2.2, 1.7, 1.0])], 0.5);
    // 4 × 3 × 2 parts; the cells in the middle of three have a node of their own.
    assert_eq!(mesh.nodes.len(), 5 * 4 * 3 - 3 * 2 + 2 * (4 + 2));
    assert!((area(&mesh) - 2.0 * (2.2 * 1.7 + 2.2 + 1.7)).abs() < 1e-13);
    assert!(leak(&mesh) < 1e-13);
}

#[test]
fn how_a_face_is_drawn_does_not_matter() {
    // The same tank with every face drawn as a fan about its middle, with points along its edges.
    let plain = tank([0.0; 3], [4.0; 3]);
    let fine = mesh(std::slice::from_ref(&plain), 1.0);
    let points = fine.nodes.iter().map(|n| n.position).collect();
    let triangles = fine.elements.iter().map(|t| t.nodes.map(|n| n as u32));
    let again = mesh(&[surface("tank", points, triangles.collect())], 0.5);
    assert_eq!(again.faces.len(), 6);
    assert_eq!(again.nodes.len(), mesh(&[plain], 0.5).nodes.len());
    assert!(again.faces.iter().all(|f| f.edges.len() == 4));
}

#[test]
fn a_sphere_has_half_the_space() {
    let mut mean = Vec::new();
    for levels in [2, 3, 4] {
        let mesh = mesh(&[icosphere(levels, 1.0)], 0.5);
        assert_eq!(mesh.nodes.len(), 10 * 4usize.pow(levels as u32) + 2);
        mean.push(mesh.nodes.iter().map(|n| n.theta).sum::<f64>() / mesh.nodes.len() as f64);
        assert!(leak(&mesh) < 1e-12);
        assert!(mesh.free_edges.is_empty());
    }
    println!("mean θ on icospheres of 320, 1280, 5120 triangles: {mean:?}");
    // θ = 1/2 + Σ δ / 4π, and the angles δ go with the size of the facets.
    let ratio = |k: usize| (mean[k] - 0.5) / (mean[k + 1] - 0.5);
    assert!((ratio(0) - 2.0).abs() < 0.05 && (ratio(1) - 2.0).abs() < 0.02);
    let mesh = mesh(&[icosphere(3, 1.0).reversed()], 0.2);
    assert_eq!((mesh.nodes.len(), mesh.elements.len()), (642, 1280));
    let mean = mesh.nodes.iter().map(|n| n.theta).sum::<f64>() / 642.0;
    println!("mean θ inside the icosphere of 1280 triangles: {mean}");
    assert!(mesh.nodes.iter().all(|n| n.theta < 0.5 && n.theta > 0.42));
}

#[test]
fn a_pipe_closes_through_periodicity() {
    // 24 sides of 2 sin(7.5°) = 0.261, the fluid inside, a period of 2 along z.
    let ring = polygon(24, 1.0);
    let pipe = prism("pipe", &ring, [0.0, 2.0], false).reversed();
    let domain = periodic([-1.5, -1.5, 0.0], [1.5, 1.5, 2.0], [false, false, true]);
    let mesh = mesh_in(std::slice::from_ref(&pipe), 0.25, &domain);
    assert!(mesh.free_edges.is_empty());
    // One part across every side, eight along the period.
    let counts = [mesh.nodes.len(), mesh.elements.len()];
    assert_eq!(counts, [24 * 8, 24 * 8 * 2]);
    let thetas = mesh.nodes.iter().map(|n| n.theta);
    thetas.for_each(|theta| close(theta, 0.5 - 1.0 / 24.0, 1e-14, "θ"));
    // The last ring meets the first one's nodes.
    let moved = mesh.elements.iter().filter(|t| t.images != [[0; 3]; 3]);
    assert_eq!(moved.count(), 24 * 2);
    let side = 2.0 * (std::f64::consts::PI / 24.0).sin();
    close(area(&mesh), 24.0 * 2.0 * side, 1e-12, "area");
    let mut mesh = mesh;
    let along = Pose {
        translation: [0.0, 0.0, 0.3],
        ..Pose::default()
    };
    mesh.move_walls(&[along]).unwrap();
    let turned = mesh.move_walls(&[Pose::turned_about([0.0, 0.0, 1.0], 0.1, [0.0; 3])]);
    assert_eq!(
        turned.unwrap_err().to_string(),
        "wall `pipe` is closed through periodicity and cannot rotate"
    );
    let open = crate::surface::shapes::mesh(&[pipe], 0.25);
    assert_eq!(open.openings.len(), 2);
    assert!(open.openings.iter().all(|o| o.edges == 24));
}

#[test]
fn a_floor_of_two_periods_has_no_edge() {
    let floor = floor([0.0; 2], [4.0, 3.0]);
    let domain = periodic([0.0; 3], [4.0, 3.0, 2.0], [true, true, false]);
    let mesh = mesh_in(&[floor], 0.5, &domain);
    assert!(mesh.free_edges.is_empty());
    assert_eq!((mesh.nodes.len(), mesh.elements.len()), (48, 96));
    for node in &mesh.nodes {
        assert_eq!(node.theta, 0.5);
        close(node.size, 1.0, 1e-14, node.position);
    }
}

#[test]
fn walls_of_a_group_move_together() {
    let tank = tank([0.0; 3], [4.0; 3]);
    let body = block("body", [1.0; 3], [2.0; 3]);
    let lid = block("lid", [1.0, 1.0, 2.0], [2.0, 2.0, 3.0]);
    let walls = [tank, body, lid];
    let mut mesh = Mesh::<3>::build(&walls, &[0, 1, 1], 0.5, &PeriodicBox::none()).unwrap();
    let before = mesh.clone();
    let turn = Pose {
        translation: [0.25, 0.0, 0.5],
        ..Pose::turned_about([0.0, 0.0, 1.0], 0.5, [1.5, 1.5, 1.5])
    };
    let rest = Pose::default();
    let refused = mesh.move_walls(&[rest, turn, rest]).unwrap_err();
    assert_eq!(
        refused.to_string(),
        "walls `body` and `lid` move together and cannot be given different motions"
    );
    mesh.move_walls(&[rest, turn, turn]).unwrap();
    let poses = [rest, turn, turn];
    for (a, b) in before.nodes.iter().zip(&mesh.nodes) {
        let expected = poses[a.wall].map()(a.position);
        assert_eq!((b.position, b.theta), (expected, a.theta));
    }
    for (a, b) in before.elements.iter().zip(&mesh.elements) {
        close(a.measure, b.measure, 1e-15, "area");
        let turned = poses[a.wall].turned(a.normal);
        assert!(norm(minus(b.normal, turned)) < 1e-14);
        assert!(norm(minus(b.normal, mesh.faces[b.face].normal)) < 1e-14);
    }
    assert!(!mesh.contains([1.75, 1.5, 2.9]) && mesh.contains([1.75, 1.5, 1.4]));
    mesh.move_walls(&[rest, rest, rest]).unwrap();
    assert_eq!(&mesh.nodes, &before.nodes);
    assert!(mesh.contains([1.5, 1.5, 3.2]) && !mesh.contains([1.5, 1.5, 1.2]));
    assert!(mesh.move_walls(&[rest]).is_err());
}

/// Every triangle of a box has its mirror image among the others, whether the parts of its sides are even or odd.
#[test]
fn a_box_is_its_own_mirror_image() {
    let size = [2.0, 1.5, 2.5];
    let mesh = mesh(&[tank([0.0; 3], size)], 0.5);
    let corners = |t: usize, mirrored: usize| {
        let mut places = mesh.corners(t).map(|corner| {
            let mut place = corner;
            if mirrored < 3 {
                place[mirrored] = size[mirrored] - place[mirrored];
            }
            place.map(|x| (x * 1e6).round() as i64)
        });
        places.sort_unstable();
        places
    };
    let set = |mirrored: usize| -> std::collections::BTreeSet<[[i64; 3]; 3]> {
        let all = 0..mesh.elements.len();
        all.map(|t| corners(t, mirrored)).collect()
    };
    let drawn = set(3);
    assert_eq!(drawn.len(), mesh.elements.len());
    (0..3).for_each(|axis| assert_eq!(set(axis), drawn, "along axis {axis}"));
}
