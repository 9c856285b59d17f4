//! θ and γ in a right-angled corner and at a re-entrant one.

use sph_boundary::Polyline;
use sph_core::Vect;

use crate::bench::{Bench, fixed_line, wide};

/// A room of 8 × 8 with a block of 4 × 4 taken from its upper right; h = 1.
fn room(positions: Vec<Vect<2>>) -> Bench<2> {
    let corners = [
        [0.0, 0.0],
        [8.0, 0.0],
        [8.0, 4.0],
        [4.0, 4.0],
        [4.0, 8.0],
        [0.0, 8.0],
    ];
    let room = Polyline::closed("room", corners.to_vec());
    Bench::new("usaw", &[fixed_line(room)], 0.5, wide(), positions)
}

#[test]
fn vertices_carry_a_quarter_in_a_corner_and_three_at_a_re_entrant_one() {
    let bench = room(vec![Vect::<2>::new(2.0, 2.0)]);
    let points = &bench.world.walls.points;
    let share = |place: Vect<2>| {
        let all = points.position.iter().zip(&points.share);
        let found = all.filter(|(x, _)| (*x - place).norm() < 1e-12);
        let found: Vec<f64> = found.map(|(_, share)| *share).collect();
        assert_eq!(found.len(), 1, "one vertex at {place}");
        found[0]
    };
    // An arctangent of exact components: within an ulp or two.
    for (x, y, expected) in [
        (0.0, 0.0, 0.25),
        (8.0, 0.0, 0.25),
        (4.0, 4.0, 0.75),
        (2.0, 0.0, 0.5),
    ] {
        let found = share(Vect::<2>::new(x, y));
        assert!((found - expected).abs() < 1e-15, "({x}, {y}): {found}");
    }
}

#[test]
fn gamma_is_69645881_in_a_corner_and_90540692_at_a_re_entrant_one() {
    let bench = room(vec![Vect::<2>::new(0.4, 0.7), Vect::<2>::new(4.3, 3.4)]);
    let corner = bench.gamma()[bench.at(Vect::<2>::new(0.4, 0.7))];
    assert!((corner - 0.696_458_81).abs() < 5.1e-9, "{corner}");
    let re_entrant = bench.gamma()[bench.at(Vect::<2>::new(4.3, 3.4))];
    assert!((re_entrant - 0.905_406_92).abs() < 5.1e-9, "{re_entrant}");
}
