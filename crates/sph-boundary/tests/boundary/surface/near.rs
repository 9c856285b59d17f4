//! Triangles near a point, and the nearest place on them.

use sph_boundary::{ElementTree, Feature, Mesh, NearElement, NearRows, SeenElement};

use crate::surface::shapes::*;

fn sampled(corners: [Point; 3], n: usize) -> f64 {
    let mut nearest = f64::INFINITY;
    for i in 0..=n {
        for j in 0..=n - i {
            let (u, v) = (i as f64 / n as f64, j as f64 / n as f64);
            let [a, b, c] = corners;
            let at = plus(plus(a, u, minus(b, a)), v, minus(c, a));
            nearest = nearest.min(norm(at));
        }
    }
    nearest
}

#[test]
fn the_nearest_place_against_samples() {
    let mesh = mesh(&[pyramid([0.0, 0.0], 1.0, 0.0, 1.3)], 0.4);
    let mut random = Random(3);
    let mut features = [0; 3];
    let mut worst: f64 = 0.0;
    for _ in 0..300 {
        let point = random.within([-1.2, -1.2, -0.2], [1.2, 1.2, 1.4]);
        for triangle in (0..mesh.elements.len()).step_by(7) {
            let near = NearElement {
                element: triangle as u32,
                image: [0; 3],
            };
            let closest = mesh.closest(point, near);
            let corners = mesh.corners_from(point, near);
            let samples = sampled(corners, 60);
            // The samples are half a step of 0.4/60 off at most.
            assert!(closest.distance() <= samples + 1e-12);
            assert!(samples - closest.distance() < 0.006);
            worst = worst.max(samples - closest.distance());
            let normal = mesh.elements[triangle].normal;
            assert!((closest.height + dot(corners[1], normal)).abs() < 1e-12);
            match closest.feature {
                Feature::Face => {
                    assert!((closest.distance() - closest.height.abs()).abs() < 1e-12);
                    features[0] += 1;
                }
                Feature::Edge(e) => {
                    let e = e as usize;
                    let edge = minus(corners[(e + 1) % 3], corners[e]);
                    assert!(dot(closest.offset, edge).abs() < 1e-12);
                    features[1] += 1;
                }
                Feature::Corner(c) => {
                    assert_eq!(closest.offset, corners[c as usize]);
                    features[2] += 1;
                }
            }
        }
    }
    println!("faces, edges, corners: {features:?}; samples at most {worst:.2e} m farther");
    assert!(features.iter().all(|n| *n > 50));
}

fn all_near(mesh: &Mesh<3>, point: Point, radius: f64) -> Vec<NearElement<3>> {
    let mut found = Vec::new();
    let range = |k: usize| match mesh.domain.periodic[k] {
        true => -2..=2i8,
        false => 0..=0,
    };
    for element in 0..mesh.elements.len() as u32 {
        for i in range(0) {
            for j in range(1) {
                for k in range(2) {
                    let image = [i, j, k];
                    let near = NearElement { element, image };
                    if mesh.closest(point, near).distance() < radius {
                        found.push(near);
                    }
                }
            }
        }
    }
    found
}

/// A pipe along one period and a body across another one.
fn pipe_and_body() -> Mesh<3> {
    let pipe = prism("pipe", &polygon(12, 1.0), [0.0, 2.0], false).reversed();
    let domain = periodic([-1.5, -1.5, 0.0], [1.5, 1.5, 2.0], [true, false, true]);
    let body = block("body", [1.25, -0.2, 0.5], [1.75, 0.2, 1.0]);
    mesh_in(&[pipe, body], 0.25, &domain)
}

#[test]
fn the_tree_finds_all_and_only_those() {
    let mesh = pipe_and_body();
    assert_eq!(size_of::<NearElement<3>>(), 8);
    let mut random = Random(11);
    let mut found = 0;
    for reach in [0.1, 0.6, 1.1] {
        let tree = ElementTree::build(&mesh, reach);
        for radius in [reach, 0.7 * reach] {
            for _ in 0..200 {
                let point = random.within([-1.55, -1.8, -0.1], [1.55, 1.8, 2.1]);
                let near: Vec<_> = tree.near(&mesh, point, radius).collect();
                assert_eq!(near, all_near(&mesh, point, radius), "{point:?}");
                found += near.len();
            }
        }
    }
    println!("{found} triangles found, as by brute force");
    let none = mesh_in(&[], 1.0, &mesh.domain);
    let tree = ElementTree::build(&none, 1.0);
    assert_eq!(tree.near(&none, [0.0; 3], 1.0).count(), 0);
}

#[test]
fn rows_of_points_together_hold_what_is_near_each() {
    let mesh = pipe_and_body();
    let mut random = Random(12);
    let (mut found, mut besides) = (0, 0);
    for (reach, radius) in [(0.6, 0.6), (1.1, 0.8)] {
        let tree = ElementTree::build(&mesh, reach);
        // Points side by side, and now and then one far away.
        let mut points = Vec::new();
        for _ in 0..40 {
            let first = random.within([-1.5, -1.5, 0.0], [1.5, 1.5, 2.0]);
            let beside = |k: usize| [0, 1, 2].map(|x| first[x] + 0.1 * (k >> x & 1) as f64);
            points.extend((0..8).map(beside));
        }
        let mut rows = NearRows::default();
        tree.rows(&points, radius, &mut rows);
        assert_eq!(rows.counts.len(), points.len());
        let mut rest = &rows.elements[..];
        for (point, count) in points.iter().zip(rows.counts) {
            let (row, after) = rest.split_at(count as usize);
            rest = after;
            let keys = row.iter().map(|n| (n.image, n.element));
            assert!(keys.is_sorted_by(|a, b| a < b));
            let near = all_near(&mesh, *point, radius);
            assert!(near.iter().all(|n| row.contains(n)), "{point:?}");
            // A sphere around a triangle of 0.25 has at most its diagonal.
            let out = |n: &NearElement<3>| mesh.closest(*point, *n).distance() > radius + 0.5;
            assert!(!row.iter().any(out), "{point:?}");
            // The same whoever is served with it.
            let mut same = NearRows::default();
            tree.rows(&[*point], radius, &mut same);
            assert_eq!(same.elements, row);
            found += near.len();
            besides += row.len() - near.len();
        }
        assert!(rest.is_empty());
    }
    println!("{found} triangles found, as by brute force, and {besides} more");
}

#[test]
fn a_node_is_the_same_vector_in_all_triangles() {
    let pipe = prism("pipe", &polygon(24, 1.0), [0.1, 2.1], false).reversed();
    let domain = periodic([-1.5, -1.5, 0.1], [1.5, 1.5, 2.1], [false, false, true]);
    let mesh = mesh_in(&[pipe], 0.25, &domain);
    let tree = ElementTree::build(&mesh, 0.8);
    let point = [0.41, 0.3, 0.2];
    let mut seen = std::collections::HashMap::new();
    let mut faces = std::collections::BTreeSet::new();
    let mut repeated = 0;
    for near in tree.near(&mesh, point, 0.8) {
        let triangle = mesh.elements[near.index()];
        faces.insert((triangle.face, near.image));
        for (k, corner) in mesh.corners_from(point, near).iter().enumerate() {
            let image = [0, 1, 2].map(|a| triangle.images[k][a] + i32::from(near.image[a]));
            if let Some(before) = seen.insert((triangle.nodes[k], image), *corner) {
                assert_eq!(before, *corner);
                repeated += 1;
            }
        }
    }
    assert!(repeated > 100);
    let edges = faces.iter();
    let edges = edges.flat_map(|(face, image)| mesh.face_edges_from(point, *face, *image));
    let known = edges.flatten().filter(|c| seen.values().any(|s| s == c));
    assert!(
        known.count() > 10,
        "corners of faces are those of triangles"
    );
}

/// A block seen from points around it: distance and side are those of the block itself.
#[test]
fn the_nearest_of_some_triangles_tells_the_side_of_a_block() {
    let mesh = mesh(&[block("block", [0.0; 3], [1.0, 2.0, 1.5])], 0.25);
    let tree = ElementTree::build(&mesh, 2.0);
    let mut random = Random(8);
    let (mut found, mut largest) = (0, 0.0_f64);
    for _ in 0..400 {
        let at = random.within([-0.5; 3], [1.5, 2.5, 2.0]);
        let offset = random.within([-0.3; 3], [0.3; 3]);
        let near = tree.near(&mesh, at, 1.5);
        let seen: Vec<_> = near.map(|n| mesh.seen(at, n)).collect();
        let place: [f64; 3] = std::array::from_fn(|k| at[k] + offset[k]);
        // Beyond the sides along every axis, negative between them.
        let [x, y, z] = [0, 1, 2].map(|k| (-place[k]).max(place[k] - [1.0, 2.0, 1.5][k]));
        let outside = norm([x, y, z].map(|d| d.max(0.0)));
        let exact = outside + x.max(y).max(z).min(0.0);
        match SeenElement::signed_distance(&seen, offset, 0.9) {
            Some(distance) => {
                found += 1;
                largest = largest.max((distance - exact).abs());
            }
            None => assert!(exact.abs() >= 0.9, "{exact} m from {place:?}"),
        }
    }
    println!("{found} of 400, {largest:.1e} m");
    assert!(found > 300 && largest < 1e-14, "{found}: {largest:e}");
}
