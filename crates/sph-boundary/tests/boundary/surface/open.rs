//! Walls with free edges.

use crate::surface::shapes::*;

/// A tank without its roof.
fn open_tank() -> sph_boundary::Surface {
    let mut tank = tank([0.0; 3], [2.0, 2.0, 4.0]);
    tank.triangles.drain(2..4);
    tank
}

#[test]
fn an_open_tank_has_a_rim() {
    let mesh = mesh(&[open_tank()], 0.5);
    assert_eq!(mesh.free_edges.len(), 16);
    let [rim] = &mesh.openings[..] else {
        panic!("one opening")
    };
    assert_eq!(rim.edges, 4);
    assert!((rim.extent - 8f64.sqrt()).abs() < 1e-14);
    // As if the walls went on above.
    assert_eq!(theta_at(&mesh, [1.0, 0.0, 4.0]), [0.5]);
    assert_eq!(theta_at(&mesh, [0.0, 0.0, 4.0]), [0.25]);
    mesh.check_free_edges(&[[1.0, 1.0, 1.0], [1.0, 1.0, 2.4]], 1.0)
        .unwrap();
    let refused = mesh.check_free_edges(&[[1.0, 1.0, 3.9], [1.5, 0.5, 3.5], [1.0, 1.9, 3.6]], 1.0);
    let message = refused.unwrap_err().to_string();
    for part in [
        "wall `tank` is open: 4 edge(s) without a neighbour",
        "at (1, 2, 4) one of them is 0.4123",
        "m from particle 2, within the kernel radius 1 m",
    ] {
        assert!(message.contains(part), "{message}");
    }
}

#[test]
fn an_open_tank_has_a_front() {
    let mesh = mesh(&[open_tank()], 0.25);
    for (point, fluid) in [
        ([1.0, 1.0, 0.5], true),
        ([1.0, 1.0, 3.9], true),
        ([1.0, 1.0, 8.0], true),
        ([-0.3, 1.0, 1.0], false),
        ([2.5, 2.5, 1.0], false),
        ([-0.5, 1.0, -0.5], false),
        ([1.0, 1.0, -3.0], false),
    ] {
        assert_eq!(mesh.contains(point), fluid, "{point:?}");
    }
}

#[test]
fn a_hole_in_a_closed_wall_is_described() {
    let mut ball = icosphere(3, 1.0).reversed();
    ball.triangles.swap_remove(100);
    let mesh = mesh(&[ball], 0.1);
    assert_eq!((mesh.openings.len(), mesh.openings[0].edges), (1, 3));
    // Particles fill the ball.
    let mut random = Random(7);
    let points = (0..20_000).map(|_| random.within([-0.9; 3], [0.9; 3]));
    let points: Vec<Point> = points.filter(|p| norm(*p) < 0.9).collect();
    let message = mesh.check_free_edges(&points, 0.2).unwrap_err().to_string();
    let why = "3 edge(s) without a neighbour surround an opening of 0.2093";
    assert!(message.contains(why), "{message}");
}

#[test]
fn free_edges_are_met_across_a_period() {
    // A floor that ends at both sides of y, periodic along x.
    let floor = floor([0.0; 2], [4.0, 3.0]);
    let domain = periodic([0.0; 3], [4.0, 8.0, 2.0], [true, true, false]);
    let mesh = mesh_in(&[floor], 0.5, &domain);
    assert_eq!(mesh.free_edges.len(), 16);
    assert_eq!(mesh.openings.len(), 2);
    mesh.check_free_edges(&[[0.1, 1.5, 0.5], [0.1, 5.0, 0.5]], 1.0)
        .unwrap();
    let refused = mesh.check_free_edges(&[[0.1, 1.5, 0.5], [0.1, 7.6, 0.0]], 1.0);
    let message = refused.unwrap_err().to_string();
    assert!(message.contains("at (0.1, 8, 0)"), "{message}");
    assert!(message.contains("particle 1"), "{message}");
}
