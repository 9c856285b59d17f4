//! Strains around grains.

use dem_pfv::grains::{Cloud, Vector, strains};
use dem_pfv::triangulation::{Sphere, Triangulation, Vertex};
use nalgebra::Matrix3;

/// A uniform gradient is found everywhere, whatever the cells.
#[test]
fn a_uniform_strain_is_that_of_every_grain() {
    let places = Cloud::new([0.0; 3], [1.0; 3])
        .place(&[0.04; 300], 9)
        .expect("a cloud");
    let spheres: Vec<_> = places
        .iter()
        .map(|x| Sphere::new((*x).into(), 0.04))
        .collect();
    let mesh = Triangulation::of_spheres(&spheres).expect("cells");
    let number = |v: &Vertex| match v {
        Vertex::Sphere(i) => Some(*i),
        _ => None,
    };
    let cells: Vec<[usize; 4]> = mesh
        .cells
        .iter()
        .filter_map(|cell| {
            let corners: Option<Vec<usize>> = cell.vertices().iter().map(number).collect();
            corners?.try_into().ok()
        })
        .collect();
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
    assert!(
        strains(&cells, &places, &turned)
            .iter()
            .all(|s| s.amax() < 1e-9)
    );
}

#[test]
fn grains_without_cells_are_not_strained() {
    let places = vec![
        Vector::zeros(),
        Vector::x(),
        Vector::y(),
        Vector::z(),
        Vector::repeat(9.0),
    ];
    let result = strains(
        &[[0, 1, 2, 3], [0, 1, 2, 77], [0, 1, 1, 3]],
        &places,
        &places,
    );
    assert!((result[0] - Matrix3::identity()).amax() < 1e-15);
    assert_eq!(result[4], Matrix3::zeros());
}
