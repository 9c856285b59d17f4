//! Strains around grains.

use dem_pfv::grains::{Vector, strains};
use dem_pfv::triangulation::{Cell, Sphere, Triangulation, Vertex};
use nalgebra::Matrix3;

use crate::grains::cloud;

/// A uniform gradient is found everywhere, whatever the cells.
#[test]
fn a_uniform_strain_is_that_of_every_grain() {
    let places: Vec<Vector> = cloud(300, [0.04; 2], 9)
        .iter()
        .map(|g| g.position)
        .collect();
    let spheres = places.iter().map(|x| Sphere::new((*x).into(), 0.04));
    let mesh = Triangulation::of_spheres(&spheres.collect::<Vec<_>>()).expect("cells");
    let corners = |cell: &Cell| {
        cell.vertices()
            .map(|v| Vertex::sphere(v).expect("no walls"))
    };
    let cells: Vec<_> = mesh.cells.iter().map(corners).collect();
    assert!(cells.len() > 300);
    let gradient = Matrix3::new(1e-3, 2e-4, 0.0, -4e-4, -2e-3, 1e-4, 3e-4, 0.0, 5e-4);
    let moved: Vec<Vector> = places.iter().map(|x| gradient * x + Vector::x()).collect();
    let expected = (gradient + gradient.transpose()) * 0.5;
    for strain in strains(&cells, &places, &moved) {
        assert!((strain - expected).amax() < 1e-11, "{strain}");
    }
    // A turn as a whole is no strain.
    let spin = Vector::new(0.1, -0.2, 0.3);
    let turned: Vec<Vector> = places.iter().map(|x| spin.cross(x)).collect();
    let strained = strains(&cells, &places, &turned);
    assert!(strained.iter().all(|s| s.amax() < 1e-9));
}

#[test]
fn grains_without_cells_are_not_strained() {
    let far = Vector::repeat(9.0);
    let places = [Vector::zeros(), Vector::x(), Vector::y(), Vector::z(), far];
    let cells = [[0, 1, 2, 3], [0, 1, 2, 77], [0, 1, 1, 3]];
    let result = strains(&cells, &places, &places);
    assert!((result[0] - Matrix3::identity()).amax() < 1e-15);
    assert_eq!(result[4], Matrix3::zeros());
}
