//! γ and ∇γ of particles next to a plane and in the corner of a box, against closed forms.

use sph_boundary::WallSpec;
use sph_core::{Vect, fields};
use sph_kernels::{Kernel, wendland_c2};
use sph_neighbours::Domain;

use crate::bench::{Bench, wide};
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
    let table = [
        (0.1, 0.737026343, 0.574565568),
        (0.25, 0.673192978, 0.680934578),
        (0.5, 0.489440918, 0.827583313),
        (0.75, 0.286102295, 0.924097210),
        (1.0, 0.128906250, 0.974609375),
        (1.25, 0.040323257, 0.994372994),
        (1.5, 0.006774902, 0.999397278),
    ];
    let heights: Vec<f64> = table.iter().map(|row| row.0).collect();
    let bench = over_a_floor(&heights);
    for (k, (z, slope, gamma)) in table.into_iter().enumerate() {
        let i = bench.at(Vect::from([0.7 + 0.9 * k as f64, 7.9, z]));
        assert!((bench.gamma()[i] - gamma).abs() < 6e-10, "γ at {z}");
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

/// Nodes and weights of Gauss' rule of five points on (−1, 1).
fn gauss() -> [(f64, f64); 5] {
    let root = |sign: f64| (5.0 + sign * 2.0 * (10.0_f64 / 7.0).sqrt()).sqrt() / 3.0;
    let weight = |sign: f64| (322.0 - sign * 13.0 * 70.0_f64.sqrt()) / 900.0;
    let (inner, outer) = (root(-1.0), root(1.0));
    let (heavy, light) = (weight(-1.0), weight(1.0));
    [
        (-outer, light),
        (-inner, heavy),
        (0.0, 128.0 / 225.0),
        (inner, heavy),
        (outer, light),
    ]
}

/// Nodes and weights on panels of an eighth from `from` to `to`; a panel ends at 0.
fn rule(from: f64, to: f64) -> Vec<(f64, f64)> {
    let mut cuts = vec![from];
    let mut next = (from / 0.125).floor() * 0.125 + 0.125;
    while next < to {
        cuts.push(next);
        next += 0.125;
    }
    cuts.push(to);
    let panel = |pair: &[f64]| {
        let (middle, half) = (0.5 * (pair[0] + pair[1]), 0.5 * (pair[1] - pair[0]));
        gauss().map(|(x, w)| (middle + half * x, half * w))
    };
    cuts.windows(2).flat_map(panel).collect()
}

/// γ and ∇γ at the distances `d` from three faces of a large box, by quadrature.
fn in_a_corner(d: [f64; 3]) -> (f64, Vect<3>) {
    let kernel = wendland_c2().sampler(3, 1.0);
    let w = |r2: f64| kernel.at(r2.sqrt()).0;
    let rules = d.map(|d| rule(-d.min(2.0), 2.0));
    let mut gamma = 0.0;
    for (x, wx) in &rules[0] {
        for (y, wy) in &rules[1] {
            let flat = x * x + y * y;
            if flat < 4.0 {
                let line = rules[2].iter().map(|(z, wz)| wz * w(flat + z * z));
                gamma += wx * wy * line.sum::<f64>();
            }
        }
    }
    let gradient = Vect::from_fn(|k, _| {
        let (a, b) = (&rules[(k + 1) % 3], &rules[(k + 2) % 3]);
        let row = |(x, wx): &(f64, f64)| {
            let at = |(y, wy): &(f64, f64)| wy * w(d[k] * d[k] + x * x + y * y);
            wx * b.iter().map(at).sum::<f64>()
        };
        a.iter().map(row).sum()
    });
    (gamma, gradient)
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
        let i = bench.at(Vect::from(place));
        let (gamma, gradient) = in_a_corner(place);
        let found = (bench.gamma()[i], bench.gradient(i));
        println!(
            "{place:?}: {:.1e} {:.1e}",
            found.0 - gamma,
            (found.1 - gradient).norm()
        );
        assert!(
            (found.0 - gamma).abs() < 1e-8,
            "γ at {place:?}: {}",
            found.0
        );
        assert!((found.1 - gradient).norm() < 1e-8, "∇γ at {place:?}");
    }
}

#[test]
fn the_contact_of_a_face_is_the_integral_over_it() {
    let place = Vect::from([0.4, 1.3, 0.7]);
    let walls = [WallSpec::at_rest(wall(tank([0.0; 3], [8.0; 3])))];
    let bench = Bench::new("usaw", &walls, SPACING, wide(), vec![place]);
    let (_, expected) = in_a_corner([0.4, 1.3, 0.7]);
    let elements = &bench.world.walls.elements;
    for k in 0..3 {
        let of_face = bench.world.walls.contacts.of_particle(0).iter();
        let of_face = of_face.filter(|c| elements.normal[c.element as usize][k] > 0.5);
        let contacts: Vec<_> = of_face.collect();
        let sum: Vect<3> = contacts.iter().map(|c| c.gradient).sum();
        assert_eq!(contacts.len(), 1, "contacts of a face");
        assert!((sum[k] - expected[k]).abs() < 1e-8);
        assert_eq!(sum[(k + 1) % 3], 0.0);
        assert!(
            contacts
                .iter()
                .all(|c| (c.distance - place[k]).abs() < 1e-14)
        );
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
