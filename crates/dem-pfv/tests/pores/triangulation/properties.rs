//! Identities that hold for any spheres.

use std::collections::BTreeSet;

use dem_pfv::triangulation::{Sphere, Triangulation, Vertex, Wall};
use proptest::prelude::*;

use crate::close;
use crate::triangulation::{
    assert_consistent, canonical, lattice, least_power, random_spheres, renamed, sixfold_volume,
};

proptest! {
    #![proptest_config(ProptestConfig::with_cases(48))]

    /// Of a random cloud, with and without walls, no power centre is nearer to a foreign sphere.
    #[test]
    fn cells_are_locally_and_globally_regular(n in 4_usize..120, seed in any::<u64>(), room in any::<bool>()) {
        let spheres = random_spheres(n, seed);
        let walls = Wall::cuboid([0.0; 3], [1.0; 3]);
        let mesh = if room {
            Triangulation::within(&spheres, &walls)
        } else {
            Triangulation::of_spheres(&spheres)
        };
        let mesh = mesh.expect("spheres too small to hide");
        assert_consistent(&mesh);
        // Power centres of flat cells are far away; bound relative to their distance by the float check.
        let far = (0..mesh.cells.len()).map(|c| mesh.power_centre(c).norm_squared()).fold(1.0, f64::max);
        prop_assert!(least_power(&mesh) > -1e-11 * far);
    }

    /// The numbers of spheres are names: another order gives the same cells.
    #[test]
    fn the_order_of_spheres_does_not_matter(n in 4_usize..80, seed in any::<u64>(), shift in 1_usize..79) {
        let spheres = random_spheres(n, seed);
        let walls = Wall::cuboid([0.0; 3], [1.0; 3]);
        let shift = shift % n;
        let turned: Vec<Sphere> = (0..n).map(|i| spheres[(i + shift) % n]).collect();
        let rename = |v| match v {
            Vertex::Sphere(k) => Vertex::Sphere((k + shift) % n),
            wall => wall,
        };
        let a = Triangulation::within(&spheres, &walls).expect("cells");
        let b = Triangulation::within(&turned, &walls).expect("cells");
        prop_assert_eq!(canonical(&a), renamed(&b, rename));
    }
}

/// 1000 and 1728 sites, steps that doubles hold exactly and that they do not: every cube is degenerate, and so
/// is the hull. Cells fill the hull, none flat.
#[test]
fn lattices_are_filled_without_flat_cells() {
    for (side, step) in [(10, 0.125), (12, 0.1), (10, 1.0 / 3.0)] {
        let mesh = Triangulation::of_spheres(&lattice(side, step)).expect("a lattice");
        assert_consistent(&mesh);
        let volumes = (0..mesh.cells.len()).map(|c| sixfold_volume(&mesh, c) / 6.0);
        let hull = (f64::from(side - 1) * step).powi(3);
        close(volumes.clone().sum::<f64>() / hull, 1.0, 1e-12);
        if step == 0.125 {
            // All numbers are exact: the least cell of a cut cube is its sixth.
            assert_eq!(volumes.reduce(f64::min), Some(step.powi(3) / 6.0));
        }
        let walls = Wall::cuboid([0.0; 3], [f64::from(side) * step; 3]);
        let mesh = Triangulation::within(&lattice(side, step), &walls).expect("a lattice");
        assert_consistent(&mesh);
        let least = least_power(&mesh);
        assert!(least > -1e-13 * hull.powf(2.0 / 3.0), "{least:e} m²");
    }
}

/// Euler's relation of a ball: V − E + F − C = 1. Edges are counted from cells.
#[test]
fn cells_make_a_ball() {
    let spheres = random_spheres(400, 11);
    let mesh = Triangulation::of_spheres(&spheres).expect("cells");
    let mut edges = BTreeSet::new();
    let mut outside = 0;
    for cell in &mesh.cells {
        let v = cell.vertices();
        for i in 0..4 {
            outside += i32::from(cell.neighbour(i).is_none());
            for j in i + 1..4 {
                edges.insert((v[i].min(v[j]), v[i].max(v[j])));
            }
        }
    }
    let (cells, inner) = (mesh.cells.len() as i32, mesh.facets().count() as i32);
    assert_eq!(400 - edges.len() as i32 + inner + outside - cells, 1);
    assert_eq!(4 * cells, 2 * inner + outside);
}

/// A cube whose corner is a hair off, by one unit in the last place: the sign must be right, both ways.
#[test]
fn one_unit_in_the_last_place_decides() {
    let cut = |x: f64| {
        let mut spheres = lattice(2, 1.0);
        spheres[7].centre.x = x;
        let mesh = Triangulation::of_spheres(&spheres).expect("cells");
        let volumes = (0..mesh.cells.len()).map(|c| sixfold_volume(&mesh, c));
        let least = volumes.fold(f64::INFINITY, f64::min);
        assert!(least > 0.0, "sixfold volume {least:e}");
        canonical(&mesh)
    };
    for x in [1.5_f64.next_down(), 1.5, 1.5_f64.next_up()] {
        assert!(!cut(x).is_empty());
    }
    // Outside the circumsphere of the others it is in no conflict with the corner tetrahedron; inside it is.
    assert_ne!(cut(1.5_f64.next_down()), cut(1.5_f64.next_up()));
}
