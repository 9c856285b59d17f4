//! On which side of a wall a point is, near it and far away.

use sph_boundary::{Polyline, thin_plate};
use sph_core::Vect;

use crate::bench::{Bench, Random, fixed_line, wide};

fn around(polyline: Polyline) -> Bench<2> {
    let far = vec![Vect::<2>::new(50.0, 50.0)];
    Bench::new("usaw", &[fixed_line(polyline)], 0.5, wide(), far)
}

/// Points near the plate, within reach of its segments, and ten lengths away.
fn points() -> impl Iterator<Item = Vect<2>> {
    let mut random = Random::new(21);
    (0..3000).map(move |k| {
        let width = [1.5, 4.0, 30.0][k % 3];
        random.point(-width, width)
    })
}

#[test]
fn there_is_fluid_on_both_sides_of_a_plate_of_zero_thickness() {
    let lying = [[-1.0, 0.2], [1.0, 0.2]];
    let standing = [[0.1, -1.0], [0.1, 1.0]];
    let slanted = [[-1.0, -0.7], [1.0, 0.3]];
    let both_ways = |[a, b]: [[f64; 2]; 2]| [vec![a, b], vec![b, a]];
    let straight = [lying, standing, slanted].into_iter().flat_map(both_ways);
    let bent = vec![[-1.5, -0.5], [0.0, 0.2], [1.5, 0.2]];
    for line in straight.chain([bent]) {
        let plate = around(thin_plate("plate", &line, 0.0).unwrap());
        for x in points() {
            assert!(plate.wall.contains(&x), "{line:?}: {x} is solid");
        }
    }
}

#[test]
fn a_plate_of_some_thickness_is_solid_inside_and_nowhere_else() {
    let bench = around(thin_plate("plate", &[[-1.0, 0.2], [1.0, 0.2]], 0.6).unwrap());
    let mut solid = 0;
    for x in points() {
        let inside = x[0].abs() < 1.0 && (x[1] - 0.2).abs() < 0.3;
        assert_eq!(bench.wall.contains(&x), !inside, "{x}");
        solid += usize::from(inside);
    }
    assert!(solid > 100, "{solid} points hit the plate");
}

#[test]
fn a_room_is_fluid_inside_and_nowhere_else() {
    let corners = vec![[-1.0, -1.2], [1.2, -1.0], [0.4, 1.1], [-1.1, 1.1]];
    let bench = around(Polyline::closed("room", corners.clone()));
    let mut fluid = 0;
    for x in points() {
        let left_of_all = (0..4).all(|k| {
            let (a, b) = (Vect::from(corners[k]), Vect::from(corners[(k + 1) % 4]));
            (b - a).perp(&(x - a)) > 0.0
        });
        assert_eq!(bench.wall.contains(&x), left_of_all, "{x}");
        fluid += usize::from(left_of_all);
    }
    assert!(fluid > 100, "{fluid} points hit the room");
}
