//! Many triangles.

use std::time::Instant;

use sph_boundary::{ElementTree, Pose};

use crate::surface::shapes::*;

#[test]
fn a_ball_of_eighty_thousand_triangles() {
    let ball = icosphere(6, 1.0);
    for spacing in [0.02, 0.1, 0.006] {
        let start = Instant::now();
        let mut mesh = mesh(std::slice::from_ref(&ball), spacing);
        let built = start.elapsed();
        assert!(leak(&mesh) < 1e-12);
        let start = Instant::now();
        let tree = ElementTree::build(&mesh, 8.0 * spacing);
        let sorted = start.elapsed();
        assert!(mesh.contains([0.0, 0.0, 1.5]));
        let mut random = Random(5);
        let points = (0..10_000).map(|_| random.within([-1.2; 3], [1.2; 3]));
        let points: Vec<Point> = points.collect();
        let start = Instant::now();
        let fluid = points.iter().filter(|p| mesh.contains(**p)).count();
        let asked = start.elapsed();
        let start = Instant::now();
        let near = |p: &Point| tree.near(&mesh, *p, 4.0 * spacing).count();
        let near: usize = points.iter().map(near).sum();
        let listed = start.elapsed();
        let start = Instant::now();
        mesh.move_walls(&[Pose::turned_about([0.0, 0.0, 1.0], 0.1, [0.0; 3])])
            .unwrap();
        let moved = start.elapsed();
        println!(
            "{} triangles drawn, {} meshed at {spacing} m in {built:.2?}; tree {sorted:.2?}; 10⁴ points sided in {asked:.2?} ({fluid} fluid), listed in {listed:.2?} \
             ({near} near); moved in {moved:.2?}",
            ball.triangles.len(),
            mesh.elements.len(),
        );
        let ball = 4.0 / 3.0 * std::f64::consts::PI / 2.4f64.powi(3);
        assert!((1.0 - fluid as f64 / 1e4 - ball).abs() < 0.015);
    }
}

#[test]
fn a_large_tank() {
    let start = Instant::now();
    let walls = [
        tank([0.0; 3], [10.0, 8.0, 5.0]),
        pyramid([4.0, 4.0], 1.3, 0.0, 2.0),
    ];
    let mesh = mesh(&walls, 0.05);
    println!(
        "{} triangles of a tank in {:.2?}",
        mesh.elements.len(),
        start.elapsed()
    );
    assert!(leak(&mesh) < 1e-10);
    assert!(mesh.free_edges.is_empty());
}
