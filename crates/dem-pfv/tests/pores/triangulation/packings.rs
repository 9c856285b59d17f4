//! Packings from YADE, whose triangulation is CGAL's.

use dem_pfv::triangulation::{Triangulation, Vertex, Wall};

use crate::triangulation::{assert_consistent, least_power};
use crate::{BOX25, BOX200, BOX1000, spheres};

/// Counts of the page, §5.2: cells of YADE, facets of the reference.
#[test]
fn packings_have_the_cells_and_facets_of_yade() {
    for (text, cells, facets) in [
        (BOX25, 125, 246),
        (BOX200, 1087, 2170),
        (BOX1000, 5679, 11354),
    ] {
        let walls = Wall::cuboid([0.0; 3], [1.0; 3]);
        let mesh = Triangulation::within(&spheres(text), &walls).expect("a packing");
        assert_eq!((mesh.cells.len(), mesh.facets().count()), (cells, facets));
        assert_consistent(&mesh);
        // No sphere is nearer, in power, to a power centre than its vertices; rounding of 1 m².
        let least = least_power(&mesh);
        assert!(least > -1e-13, "least power {least:e} m²");
    }
}

#[test]
fn power_centres_lie_on_walls_and_have_equal_power() {
    let walls = Wall::cuboid([0.0; 3], [1.0; 3]);
    let mesh = Triangulation::within(&spheres(BOX200), &walls).expect("a packing");
    let mut worst = 0.0_f64;
    for (c, cell) in mesh.cells.iter().enumerate() {
        let centre = mesh.power_centre(c);
        let mut powers = Vec::new();
        for vertex in cell.vertices() {
            match vertex {
                Vertex::Sphere(k) => powers.push(mesh.spheres[k].power(centre)),
                Vertex::Wall(w) => worst = worst.max(walls[w].distance(centre).abs()),
            }
        }
        assert!(powers[0] > 0.0, "a power centre lies in the void");
        let apart = powers.iter().map(|p| (p - powers[0]).abs());
        worst = apart.fold(worst, f64::max);
    }
    // Rounding of numbers of order 1, enlarged by flat cells: measured 5.7e-17.
    println!("largest difference {worst:e}");
    assert!(worst < 1e-14, "largest difference {worst:e}");
}

#[test]
fn cells_around_a_vertex_are_those_that_have_it() {
    let walls = Wall::cuboid([0.0; 3], [1.0; 3]);
    let mesh = Triangulation::within(&spheres(BOX25), &walls).expect("a packing");
    let all = (0..25).map(Vertex::Sphere).chain((0..6).map(Vertex::Wall));
    let mut total = 0;
    for vertex in all {
        let around = mesh.cells_around(vertex);
        let has = |c: &u32| mesh.cells[*c as usize].vertices().contains(&vertex);
        assert!(around.iter().all(has));
        total += around.len();
    }
    assert_eq!(total, 4 * mesh.cells.len());
}
