//! γ and ∇γ next to a flat wall at the rows of a lattice, h/δr = 2: the USAW reference tables.

use sph_core::Vect;

use crate::bench::{Bench, over_a_flat_wall};
use crate::close;

/// Rows 1 to 4 at y = ½, 1, 1½, 2 h; ten rows fill their supports.
fn row(bench: &Bench<2>, k: usize) -> usize {
    bench.at(Vect::<2>::new(4.0, 0.5 * k as f64))
}

/// Σ_b θ_b V ∂_y w over free particles and vertices, 1/m (h = 1 m).
fn discrete_gradient(bench: &Bench<2>, i: usize) -> f64 {
    let world = &bench.world;
    let x = bench.positions()[i];
    let points = &world.walls.points;
    let slope = |y: &Vect<2>| {
        let apart = world.domain.nearest_image(x - y);
        world.kernel.at(apart.norm()).1 * apart[1]
    };
    let free = bench.positions().iter().map(|y| 0.25 * slope(y));
    let wall = points.position.iter().zip(&points.share);
    let wall = wall.map(|(y, share)| share * 0.25 * slope(y));
    free.chain(wall).sum()
}

/// Printed digits: half a unit of the last one, plus the rounding of the reference.
fn as_printed(value: f64, printed: f64, digits: i32, row: usize) {
    close(value, printed, 0.5000001 * 10f64.powi(-digits), row);
}

#[test]
fn the_lattice_sum_of_gradients_is_4808_1589_0188_0000() {
    let bench = over_a_flat_wall("usaw", 10, 0.0);
    for (k, printed) in [(1, 0.4808), (2, 0.1589), (3, 0.0188), (4, 0.0)] {
        let sum = discrete_gradient(&bench, row(&bench, k));
        as_printed(sum, printed, 4, k);
    }
}

#[test]
fn the_wall_gradient_is_4837_1363_0091_0000_along_the_normal() {
    let bench = over_a_flat_wall("usaw", 10, 0.0);
    for (k, printed) in [(1, 0.4837), (2, 0.1363), (3, 0.0091), (4, 0.0)] {
        let contacts = bench.world.walls.contacts.of_particle(row(&bench, k));
        let gradient = bench.gradient(row(&bench, k));
        as_printed(gradient[1], printed, 4, k);
        assert!(gradient[0].abs() < 1e-16, "along the wall: {}", gradient[0]);
        for contact in contacts {
            close(contact.distance, 0.5 * k as f64, 1e-15, k);
        }
    }
}

#[test]
fn gamma_is_82349691_97149094_99912974_and_1_beyond() {
    let bench = over_a_flat_wall("usaw", 10, 0.0);
    let table = [
        (1, 0.823_496_914),
        (2, 0.971_490_937),
        (3, 0.999_129_737),
        (4, 1.0),
    ];
    for (k, printed) in table {
        as_printed(bench.gamma()[row(&bench, k)], printed, 9, k);
    }
    // Out of reach there is nothing to compute, so it is 1 and not nearly 1.
    let far = row(&bench, 9);
    assert_eq!(bench.gamma()[far], 1.0);
    assert!(bench.world.walls.contacts.of_particle(far).is_empty());
}

#[test]
fn every_column_of_a_periodic_row_sees_the_same_wall() {
    let bench = over_a_flat_wall("usaw", 4, 0.0);
    let middle = bench.gamma()[row(&bench, 1)];
    let first_row = bench.positions().iter().zip(bench.gamma());
    let first_row: Vec<_> = first_row.filter(|(x, _)| x[1] == 0.5).collect();
    assert_eq!(first_row.len(), 16);
    for (x, gamma) in first_row {
        // Sums over the same segments in another order: a few roundings.
        close(*gamma, middle, 1e-14, x);
    }
}

#[test]
fn the_vertices_of_a_flat_wall_are_half_fluid() {
    let bench = over_a_flat_wall("usaw", 4, 0.0);
    let points = &bench.world.walls.points;
    assert_eq!(points.share, vec![0.5; 16]);
    assert_eq!(bench.world.walls.elements.measure, vec![0.5; 16]);
    let up = Vect::<2>::new(0.0, 1.0);
    assert!(bench.world.walls.elements.normal.iter().all(|n| *n == up));
}
