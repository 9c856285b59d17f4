//! γ and ∇γ of particles next to a plane and in the corner of a box, against closed forms.

use sph_boundary::{GammaSum, Renormalisation3d, WallSpec};
use sph_core::{Vect, fields};
use sph_kernels::wendland_c2;
use sph_neighbours::Domain;

use crate::bench::{Bench, wide};
use crate::close;
use crate::spatial::planes::PLANE;
use crate::spatial::solid::Solid;
use crate::spatial_plugin::shapes::{floor, tank, wall};

/// h = 1.
const SPACING: f64 = 0.5;

/// Particles over a floor that is periodic along x and y.
fn over_a_floor(heights: &[f64]) -> Bench<3> {
    let domain = Domain {
        lower: Vect::from([0.0, 0.0, -50.0]),
        upper: Vect::from([8.0, 8.0, 50.0]),
        periodic: [true, true, false],
    };
    let place = |(k, z): (usize, &f64)| Vect::from([0.7 + 0.9 * k as f64, 7.9, *z]);
    let positions = heights.iter().enumerate().map(place).collect();
    let walls = [WallSpec::at_rest(wall(floor(0.0, 8.0)))];
    Bench::new("usaw", &walls, SPACING, domain, positions)
}

#[test]
fn over_a_plane_gamma_and_its_gradient_are_as_printed_to_nine_digits() {
    let bench = over_a_floor(&PLANE.map(|row| row[0]));
    for (k, [z, slope, gamma]) in PLANE.into_iter().enumerate() {
        let i = bench.at(Vect::from([0.7 + 0.9 * k as f64, 7.9, z]));
        close(bench.gamma()[i], gamma, 6e-10, z);
        let gradient = bench.gradient(i);
        assert!((gradient - Vect::z() * slope).norm() < 6e-10, "∇γ at {z}");
        for contact in bench.world.walls.contacts.of_particle(i) {
            assert!((contact.distance - z).abs() < 1e-14);
        }
    }
}

#[test]
fn beyond_the_support_gamma_is_one_and_not_nearly_one() {
    let bench = over_a_floor(&[2.0, 2.2, 30.0]);
    assert_eq!(bench.gamma(), [1.0, 1.0, 1.0]);
    assert!(bench.world.walls.contacts.is_empty());
}

/// γ and ∇γ in a box of 8 m, face by face: those of the definitions by the tests of the integrals.
fn in_a_box(place: [f64; 3]) -> GammaSum<3> {
    let integrals = Renormalisation3d::new(wendland_c2().shape(), 1.0).expect("a kernel");
    Solid::new(Solid::box_of([[0.0, 8.0]; 3])).at(&integrals, place)
}

#[test]
fn in_the_corner_of_a_box_gamma_and_its_gradient_are_the_integrals_to_1e_8() {
    let places = [
        [0.5, 0.5, 0.5],
        [0.1, 0.2, 0.3],
        [0.4, 1.3, 0.7],
        [1.1, 0.05, 1.9],
        [1.5, 0.6, 3.0],
    ];
    let walls = [WallSpec::at_rest(wall(tank([0.0; 3], [8.0; 3])))];
    let positions = places.map(Vect::from).to_vec();
    let bench = Bench::new("usaw", &walls, SPACING, wide(), positions);
    for place in places {
        let (i, expected) = (bench.at(Vect::from(place)), in_a_box(place));
        close(bench.gamma()[i], expected.gamma(), 1e-8, place);
        let off = bench.gradient(i) - Vect::from(expected.gradient);
        assert!(off.norm() < 1e-8, "∇γ at {place:?} is off by {off}");
    }
}

#[test]
fn the_contact_of_a_face_is_the_integral_over_it() {
    let place = Vect::from([0.4, 1.3, 0.7]);
    let walls = [WallSpec::at_rest(wall(tank([0.0; 3], [8.0; 3])))];
    let bench = Bench::new("usaw", &walls, SPACING, wide(), vec![place]);
    let expected = in_a_box(place.into()).gradient;
    let elements = &bench.world.walls.elements;
    for k in 0..3 {
        let of_face = bench.world.walls.contacts.of_particle(0).iter();
        let of_face = of_face.filter(|c| elements.normal[c.element as usize][k] > 0.5);
        let contacts: Vec<_> = of_face.collect();
        let sum: Vect<3> = contacts.iter().map(|c| c.gradient).sum();
        assert_eq!(contacts.len(), 1, "contacts of a face");
        close(sum[k], expected[k], 1e-8, k);
        assert_eq!(sum[(k + 1) % 3], 0.0);
        close(contacts[0].distance, place[k], 1e-14, k);
    }
}

/// Where rounding is all that is left of a face, its contact is at the foot of the particle or nowhere.
#[test]
fn at_the_end_of_the_support_contacts_are_below_the_particle() {
    let support = 2.0;
    let place = |k: i32| {
        let height = support * (1.0 - 10f64.powi(-3 - k % 14));
        Vect::from([3.0 + 0.05 * f64::from(k), 7.0 - 0.04 * f64::from(k), height])
    };
    let places: Vec<_> = (0..60).map(place).collect();
    let walls = [WallSpec::at_rest(wall(tank([0.0; 3], [10.0, 10.0, 8.0])))];
    let bench = Bench::new("usaw", &walls, SPACING, wide(), places);
    let (walls, mut seen) = (&bench.world.walls, 0);
    let places = bench.world.free.get(fields::POSITION).unwrap();
    for (i, place) in places.iter().enumerate() {
        for contact in walls.contacts.of_particle(i) {
            let centre = walls.elements.centre[contact.element as usize];
            let apart = (centre - place).xy().norm();
            assert!(apart < SPACING, "{apart} m from {place:?}");
            seen += 1;
        }
    }
    assert!(seen > 0);
}
