//! Refusals of points without a triangulation name these.

use dem_pfv::triangulation::{Sphere, Triangulation, TriangulationError as Error, Wall};

use crate::assert_says;
use crate::triangulation::{lattice, random_spheres};

fn unit_box() -> [Wall; 6] {
    Wall::cuboid([0.0; 3], [1.0; 3])
}

#[test]
fn equal_centres_are_named() {
    let mut spheres = lattice(4, 0.25);
    spheres.push(Sphere {
        radius: 0.01,
        ..spheres[17]
    });
    let error = Triangulation::within(&spheres, &unit_box()).expect_err("equal");
    assert_says(&error, "spheres 17 and 64 have the same centre");
    assert_kind!(error, Error::Duplicate(17, 64, _));
    let zeros = [0.0, -0.0].map(|x| Sphere::new([x, 0.5, 0.5], 0.1));
    let walls = Wall::cuboid([-1.0; 3], [1.0; 3]);
    let error = Triangulation::within(&zeros, &walls).expect_err("equal");
    assert_kind!(error, Error::Duplicate(..));
}

/// Whether the small sphere comes first or last.
#[test]
fn a_hidden_sphere_is_named() {
    let big = Sphere::new([0.5; 3], 0.3);
    let small = Sphere::new([0.55, 0.5, 0.5], 0.05);
    for (spheres, hidden) in [([big, small], 1), ([small, big], 0)] {
        let error = Triangulation::within(&spheres, &unit_box()).expect_err("hidden");
        assert_eq!(error, Error::Hidden(hidden));
    }
}

#[test]
fn a_centre_on_or_behind_a_wall_is_named() {
    for x in [1.0, 1.2] {
        let spheres = [Sphere::new([0.5; 3], 0.1), Sphere::new([x, 0.5, 0.5], 0.1)];
        let error = Triangulation::within(&spheres, &unit_box()).expect_err("outside");
        assert_eq!(error, Error::Outside(1, 1, 1.0 - x));
    }
}

#[test]
fn spheres_in_a_plane_need_walls() {
    let refused = |spheres: &[Sphere]| Triangulation::of_spheres(spheres).expect_err("flat");
    let plane = lattice(3, 0.3).into_iter().filter(|s| s.centre.z < 0.2);
    let plane: Vec<_> = plane.collect();
    assert_eq!(refused(&plane), Error::Flat);
    assert!(Triangulation::within(&plane, &unit_box()).is_ok());
    let line = [0, 1, 2, 3, 4].map(|i| Sphere::new([f64::from(i) / 7.0, 0.1, 0.2], 0.01));
    assert_eq!(refused(&line), Error::Flat);
    assert_eq!(refused(&plane[..3]), Error::TooFew(3, 4));
    let none = Triangulation::within(&[], &unit_box()).expect_err("none");
    assert_kind!(none, Error::TooFew(..));
}

#[test]
fn numbers_that_are_none_are_named() {
    let mut spheres = random_spheres(10, 1);
    spheres[3].radius = -0.1;
    let error = Triangulation::of_spheres(&spheres).expect_err("negative");
    assert_kind!(error, Error::BadSphere(3, ..));
    spheres[3].radius = 0.1;
    spheres[5].centre.y = f64::NAN;
    let error = Triangulation::of_spheres(&spheres).expect_err("nowhere");
    assert_kind!(error, Error::BadSphere(5, ..));
    let mut walls = unit_box();
    walls[2].normal *= 2.0;
    let error = Triangulation::within(&random_spheres(10, 1), &walls).expect_err("long");
    assert_kind!(error, Error::BadWall(2, ..));
}

#[test]
fn walls_that_close_no_room_are_named() {
    let spheres = [Sphere::new([0.5; 3], 0.1)];
    let open = Triangulation::within(&spheres, &unit_box()[..5]).expect_err("open");
    assert_kind!(open, Error::Open(..));
    let floor = Triangulation::within(&spheres, &unit_box()[4..5]).expect_err("open");
    assert_kind!(floor, Error::Open(..));
    let mut walls = unit_box().to_vec();
    walls.push(Wall::through([0.0, 0.0, -1.0], [0.0, 0.1, 1.0]));
    let idle = Triangulation::within(&spheres, &walls).expect_err("idle");
    assert_eq!(idle, Error::IdleWall(6));
    let sides = [[1.0, 0.0], [-1.0, 0.0], [0.0, 1.0], [0.0, -1.0]];
    let tip = |n: [f64; 2]| Wall::through([0.5, 0.5, 1.0], [n[0], n[1], -1.0]);
    let mut pyramid: Vec<_> = sides.into_iter().map(tip).collect();
    pyramid.push(unit_box()[4]);
    let error = Triangulation::within(&spheres, &pyramid).expect_err("four walls in a point");
    assert_kind!(error, Error::FourWallsMeet(_));
}
