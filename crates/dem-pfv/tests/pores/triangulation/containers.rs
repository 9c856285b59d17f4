//! Walls that are no box.

use dem_pfv::triangulation::{Sphere, Triangulation, Vertex, Wall};

use crate::triangulation::{assert_consistent, least_power, random_spheres};

/// Eight walls around a column with an octagon as its floor, and two ends.
fn octagon() -> Vec<Wall> {
    let side = |i: i32| {
        let a = f64::from(i) * std::f64::consts::FRAC_PI_4;
        Wall::through(
            [0.5 + 0.5 * a.cos(), 0.5 + 0.5 * a.sin(), 0.0],
            [-a.cos(), -a.sin(), 0.0],
        )
    };
    let ends = [
        Wall::through([0.0; 3], [0.0, 0.0, 1.0]),
        Wall::through([0.0, 0.0, 1.0], [0.0, 0.0, -1.0]),
    ];
    (0..8).map(side).chain(ends).collect()
}

#[test]
fn a_column_with_eight_sides_is_filled() {
    let walls = octagon();
    let inside = |s: &Sphere| walls.iter().all(|w| w.distance(s.centre) > s.radius);
    let spheres: Vec<_> = random_spheres(300, 5).into_iter().filter(inside).collect();
    let mesh = Triangulation::within(&spheres, &walls).expect("a room");
    assert_consistent(&mesh);
    // One corner cell for each corner of the room, and one sphere each.
    let corners = mesh.cells.iter().filter(|c| c.walls() == 3).count();
    assert_eq!(corners, 16);
    let least = least_power(&mesh);
    assert!(least > -1e-12, "least power {least:e} m²");
}

#[test]
fn one_sphere_in_a_box_has_its_eight_corners() {
    let walls = Wall::cuboid([-1.0; 3], [2.0; 3]);
    let mesh = Triangulation::within(&[Sphere::new([0.0; 3], 0.5)], &walls).expect("a room");
    assert_eq!((mesh.cells.len(), mesh.facets().count()), (8, 12));
    assert_eq!(mesh.cells_around(Vertex::Sphere(0)).len(), 8);
    for c in 0..8 {
        let corner = mesh.power_centre(c);
        assert!(corner.iter().all(|x| *x == -1.0 || *x == 2.0), "{corner}");
    }
}

/// Coordinates far from 1 are scaled by a power of two, and lead to the same cells.
#[test]
fn a_power_of_two_in_the_units_changes_nothing() {
    let spheres = random_spheres(200, 3);
    let cells = |unit: f64| {
        let scaled = spheres.iter().map(|s| Sphere {
            centre: s.centre * unit,
            radius: s.radius * unit,
        });
        let walls = Wall::cuboid([0.0; 3], [unit; 3]);
        let mesh = Triangulation::within(&scaled.collect::<Vec<_>>(), &walls).expect("cells");
        mesh.cells.to_vec()
    };
    assert_eq!(cells(1.0), cells(2.0_f64.powi(80)));
    assert_eq!(cells(1.0), cells(2.0_f64.powi(-80)));
}
