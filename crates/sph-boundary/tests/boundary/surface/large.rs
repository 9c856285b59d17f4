//! Many triangles.

use sph_boundary::{ElementTree, Pose};

use crate::close;
use crate::surface::shapes::*;

#[test]
fn a_ball_of_eighty_thousand_triangles() {
    let ball = icosphere(6, 1.0);
    let volume = 4.0 / 3.0 * std::f64::consts::PI / 2.4f64.powi(3);
    for spacing in [0.02, 0.1, 0.006] {
        let mut mesh = mesh(std::slice::from_ref(&ball), spacing);
        assert!(leak(&mesh) < 1e-12);
        assert!(mesh.contains([0.0, 0.0, 1.5]));
        let mut random = Random(5);
        let points = (0..10_000).map(|_| random.within([-1.2; 3], [1.2; 3]));
        let points: Vec<Point> = points.collect();
        let fluid = points.iter().filter(|p| mesh.contains(**p)).count();
        close(1.0 - fluid as f64 / 1e4, volume, 0.015, spacing);
        let tree = ElementTree::build(&mesh, 8.0 * spacing);
        let near = |p: &Point| tree.near(&mesh, *p, 4.0 * spacing).count();
        assert!(points.iter().map(near).sum::<usize>() > 0);
        let turn = Pose::turned_about([0.0, 0.0, 1.0], 0.1, [0.0; 3]);
        mesh.move_walls(&[turn]).unwrap();
    }
}

#[test]
fn a_large_tank() {
    let walls = [
        tank([0.0; 3], [10.0, 8.0, 5.0]),
        pyramid([4.0, 4.0], 1.3, 0.0, 2.0),
    ];
    let mesh = mesh(&walls, 0.05);
    assert!(leak(&mesh) < 1e-10);
    assert!(mesh.free_edges.is_empty());
}
