//! §5.2 of the page, `partition-of-space`: signed parts add up to the room, the void and the surface.

use std::f64::consts::PI;

use dem_pfv::flow::{PoreGeometry, SlipCondition, SolidAngles, cell_volumes};
use dem_pfv::triangulation::{Sphere, Vertex};
use nalgebra::Vector3;

use crate::flow::{PACKINGS, geometry, packed};
use crate::{BOX25, BOX200, BOX1000, close, spheres};

fn solid(spheres: &[Sphere]) -> f64 {
    let volumes = spheres.iter().map(|s| 4.0 / 3.0 * PI * s.radius.powi(3));
    volumes.sum()
}

/// Largest relative difference of all sums from what they should be.
fn worst(geometry: &PoreGeometry, spheres: &[Sphere]) -> f64 {
    let void = 1.0 - solid(spheres);
    let mut wetted = vec![0.0; spheres.len()];
    let mut walls = [0.0; 6];
    for throat in &geometry.throats {
        for (v, area) in throat.vertices.iter().zip(throat.wetted) {
            match v {
                Vertex::Sphere(k) => wetted[*k] += area,
                Vertex::Wall(w) => walls[*w] += area,
            }
        }
    }
    let sum = |values: &mut dyn Iterator<Item = f64>| values.sum::<f64>();
    let throats = &geometry.throats;
    let mut differences = vec![
        sum(&mut geometry.volumes.iter().copied()) - 1.0,
        sum(&mut throats.iter().map(|t| t.area * t.length / 3.0)) - 1.0,
        sum(&mut throats.iter().map(|t| t.fluid_volume)) / void - 1.0,
        sum(&mut geometry.void_volumes.iter().copied()) / void - 1.0,
    ];
    let wetted = spheres.iter().zip(wetted);
    differences.extend(wetted.map(|(s, a)| a / (4.0 * PI * s.radius * s.radius) - 1.0));
    differences.extend(walls.map(|a| a - 1.0));
    for w in 0..6 {
        let cells = 0..geometry.volumes.len();
        differences.push(sum(&mut cells.map(|c| geometry.area_on_wall(c, w))) - 1.0);
    }
    differences.into_iter().fold(0.0, |m, d| m.max(d.abs()))
}

#[test]
fn signed_parts_fill_the_box_the_void_and_the_surfaces() {
    for (name, text) in PACKINGS {
        let spheres = spheres(text);
        let geometry = geometry(&spheres, SlipCondition::NoSlip, SolidAngles::Signed);
        let worst = worst(&geometry, &spheres);
        println!("{name}: largest relative difference {worst:e}");
        assert!(worst < 1e-12, "{name}: {worst:e}");
        let mut throats = geometry.throats.iter();
        assert!(throats.all(|t| t.fluid_volume >= 0.0), "{name}");
    }
}

/// Sectors and the fluid's part make up the facet, and P_iP_j stands on it.
#[test]
fn power_centres_are_on_the_normal_of_their_facet() {
    let geometry = packed(BOX1000);
    let mut worst = 0.0_f64;
    for t in &geometry.throats {
        let [i, j] = t.cells;
        let along = geometry.centres[j] - geometry.centres[i];
        assert!(along.dot(&t.normal) >= 0.0);
        worst = worst.max(along.cross(&t.normal).norm());
        let parts = t.fluid_area + t.sectors.iter().sum::<f64>();
        close(parts / t.area, 1.0, 1e-12);
    }
    println!("largest distance from the normal {worst:e} m");
    assert!(worst < 1e-12, "{worst:e} m");
}

/// Absolute values count too much surface: the reference's void volumes.
#[test]
fn absolute_parts_miss_as_much_void_as_the_prototype() {
    for (text, phi) in [
        (BOX25, 0.484_140_874_511_468_5),
        (BOX200, 0.438_331_171_862_808_1),
    ] {
        let geometry = geometry(&spheres(text), SlipCondition::NoSlip, SolidAngles::Absolute);
        let sum: f64 = geometry.throats.iter().map(|t| t.fluid_volume).sum();
        close(sum / phi, 1.0, 1e-12);
    }
}

/// With the connectivity kept, moved spheres and walls still fill the room, and a centre's part in the volume of
/// its cells changes by −⅓ S of the facet opposite; here the sum over all cells is zero.
#[test]
fn volumes_of_moved_spheres_fill_the_moved_room() {
    let geometry = packed(BOX200);
    let mut walls = geometry.mesh.walls.to_vec();
    walls[3].offset = -0.99; // y₊ at 0.99 m
    let moved =
        |i: usize| 1e-3 * Vector3::new((i as f64).sin(), (3.0 * i as f64).cos(), (i as f64).cos());
    let centres = geometry.mesh.spheres.iter().enumerate();
    let centres: Vec<_> = centres.map(|(i, s)| s.centre + moved(i)).collect();
    let volumes = cell_volumes(&geometry.mesh, &centres, &walls);
    close(volumes.iter().sum::<f64>() / 0.99, 1.0, 1e-13);
    let mut pairs = volumes.iter().zip(&geometry.volumes);
    assert!(pairs.all(|(a, b)| a != b));
}

/// A third of the distance times the area, over both sides of every face.
fn pyramids(geometry: &PoreGeometry) -> f64 {
    let mesh = &geometry.mesh;
    let pyramid = |edge: &dem_pfv::flow::Edge| {
        let height = match edge.other {
            // Both pyramids on one face: their heights add up to the distance of the centres.
            Vertex::Sphere(l) => (mesh.spheres[l].centre - mesh.spheres[edge.sphere].centre).norm(),
            Vertex::Wall(w) => mesh.walls[w].distance(mesh.spheres[edge.sphere].centre),
        };
        edge.area * height / 3.0
    };
    geometry.edges().iter().map(pyramid).sum()
}

#[test]
fn pyramids_over_the_faces_between_neighbours_fill_the_box() {
    for (name, text) in PACKINGS {
        let geometry = packed(text);
        close(pyramids(&geometry), 1.0, 1e-12);
        let edges = geometry.edges();
        let walls = edges.iter().filter(|e| e.other.sphere().is_none());
        close(walls.map(|e| e.area).sum(), 6.0, 1e-12);
        let least = edges.iter().map(|e| e.area).fold(f64::INFINITY, f64::min);
        assert!(least > -1e-12, "{name}: a face of {least} m²");
    }
}

#[test]
fn faces_of_a_lattice_are_squares() {
    let place = |k: usize| 0.125 + 0.25 * k as f64;
    let site = |k: usize| [k % 4, k / 4 % 4, k / 16].map(place);
    let spheres: Vec<_> = (0..64).map(|k| Sphere::new(site(k), 0.1)).collect();
    let geometry = geometry(&spheres, SlipCondition::Slip, SolidAngles::Signed);
    let (mut squares, mut rest) = (0, 0.0_f64);
    for edge in geometry.edges() {
        // Sixteenths of a unit square between neighbours and on walls; nothing across diagonals.
        if (edge.area - 0.0625).abs() < 1e-12 {
            squares += 1;
        } else {
            rest = rest.max(edge.area.abs());
        }
    }
    assert_eq!(squares, 3 * 4 * 4 * 3 + 6 * 16);
    assert!(rest < 1e-12, "{rest}");
}
