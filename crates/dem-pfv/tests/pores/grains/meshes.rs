//! Spheres on triangles.

use dem_pfv::grains::{Grain, GrainSystem, Mesh, Setup, Vector};

use crate::close;
use crate::grains::{GRAVITY, RADIUS, STIFFNESS, floor, grain, law, position, run, spin, velocity};

/// A plate z = 0 of 2·n² triangles that share no vertex, as files of triangles have them.
fn plate(n: i32) -> Mesh {
    let (mut vertices, mut triangles) = (Vec::new(), Vec::new());
    for i in 0..n * n {
        let along = |k: i32| f64::from(k) / 4.0 - 1.0;
        let corner = |a: i32, b: i32| [along(i % n + a), along(i / n + b), 0.0];
        for three in [[(0, 0), (1, 0), (1, 1)], [(0, 0), (1, 1), (0, 1)]] {
            let first = vertices.len() as u32;
            vertices.extend(three.map(|(a, b)| corner(a, b)));
            triangles.push([first, first + 1, first + 2]);
        }
    }
    Mesh::new(vertices, triangles)
}

/// A ball by itself, under gravity on a mesh or on the floor.
fn ball_on(mesh: Option<Mesh>, ball: Grain) -> GrainSystem {
    let setup = Setup::new(vec![ball], law(0.5, 0.3, 0.1)).gravity([0.0, 0.0, -GRAVITY]);
    GrainSystem::new(match mesh {
        Some(mesh) => setup.mesh(mesh),
        None => setup.walls([floor()]),
    })
    .expect("a ball")
}

/// In equilibrium above z = 0.
fn lying() -> Grain {
    grain(-0.5, -0.3, RADIUS - GRAVITY / STIFFNESS)
}

/// Sliding, then rolling over edges and corners: nothing is felt of them.
#[test]
fn a_plate_of_triangles_is_a_wall() {
    let ball = lying().moving([0.6, 0.43, 0.0]);
    let [mut on_wall, mut on_mesh] = [None, Some(plate(8))].map(|mesh| ball_on(mesh, ball));
    let step = 0.2 * on_wall.critical_step();
    for _ in 0..4000 {
        on_wall.step(step).expect("a step");
        on_mesh.step(step).expect("a step");
        assert_eq!(on_mesh.contacts().count(), 1);
        let apart = position(&on_mesh, 0) - position(&on_wall, 0);
        assert!(apart.norm() < 1e-10, "{apart}");
    }
    assert!(position(&on_wall, 0).x > 0.5);
    assert!((on_mesh.meshes[0].force - on_wall.walls[0].force).norm() < 1e-6 * GRAVITY);
}

#[test]
fn a_ridge_counts_once_and_a_valley_twice() {
    let touches = |sign: f64, height: f64| {
        let vertices = vec![
            [-1.0, 0.0, 0.0],
            [1.0, 0.0, 0.0],
            [0.0, 1.0, sign],
            [0.0, -1.0, sign],
        ];
        let mesh = Mesh::new(vertices, vec![[0, 1, 2], [1, 0, 3]]);
        let system = ball_on(Some(mesh), grain(0.0, 0.0, height));
        let contacts = system.contacts().map(|c| (c.normal, c.overlap));
        contacts.collect::<Vec<_>>()
    };
    let ridge = touches(-1.0, 0.95 * RADIUS);
    assert_eq!(ridge.len(), 1);
    assert!((ridge[0].0 - Vector::z()).norm() < 1e-12);
    close(ridge[0].1, 0.05 * RADIUS, 1e-12);
    // In a valley of 45° the distance from both sides is z/√2.
    let valley = touches(1.0, 0.95 * RADIUS * 2.0_f64.sqrt());
    assert_eq!(valley.len(), 2);
    for (normal, overlap) in valley {
        close(normal.z, 0.5_f64.sqrt(), 1e-12);
        close(overlap, 0.05 * RADIUS, 1e-12);
    }
}

/// The corner of a cube: three triangles or more meet, and one contact is found.
#[test]
fn a_corner_counts_once() {
    let vertices = vec![[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    let mesh = Mesh::new(vertices, vec![[0, 2, 1], [0, 1, 3], [0, 3, 2]]);
    let at = -0.97 * RADIUS / 3.0_f64.sqrt();
    let system = ball_on(Some(mesh), grain(at, at, at));
    assert_eq!(system.contacts().count(), 1);
}

/// A ball laid on a belt of speed U ends rolling at 2/7 U.
#[test]
fn a_belt_drags_a_ball_to_two_sevenths() {
    let mut belt = plate(8);
    belt.velocity = Vector::new(0.3, 0.0, 0.0);
    let mut system = ball_on(Some(belt), lying());
    let step = 0.2 * system.critical_step();
    run(&mut system, step, 2000);
    let depth = GRAVITY / STIFFNESS / RADIUS;
    let expected = 2.0 / 7.0 * 0.3;
    close(velocity(&system, 0).x, expected, depth * expected);
    close(spin(&system, 0).y * RADIUS, expected - 0.3, depth * 0.3);
}

/// A turntable: the mesh turns, its torque is what the ball's spin takes up.
#[test]
fn a_turning_mesh_moves_what_lies_on_it() {
    let mut table = plate(8);
    table.spin.z = 1.0;
    let mut system = ball_on(Some(table), grain(0.2, 0.0, 0.999 * RADIUS));
    let step = 0.2 * system.critical_step();
    run(&mut system, step, 2);
    system.evaluate().expect("forces");
    // At (0.2, 0) the table moves along +y and takes the ball with it.
    assert!(system.grains.contact_force[0].y > 0.0);
    let vertex = system.meshes[0].vertices[0];
    close(vertex.norm(), 2.0_f64.sqrt(), 1e-12);
    let turned = (-1.0_f64).atan2(-1.0) + 2.0 * step;
    close(vertex.y.atan2(vertex.x), turned, 1e-9);
}
