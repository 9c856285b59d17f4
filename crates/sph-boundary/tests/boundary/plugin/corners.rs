//! θ and γ in a right-angled corner and at a re-entrant one.

use sph_boundary::Polyline;
use sph_core::Vect;

use crate::bench::{Bench, fixed_line, wide};
use crate::close;

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
    // An arctangent of exact components: within an ulp or two.
    for (x, y, expected) in [
        (0.0, 0.0, 0.25),
        (8.0, 0.0, 0.25),
        (4.0, 4.0, 0.75),
        (2.0, 0.0, 0.5),
    ] {
        let found = bench.shares_at(Vect::<2>::new(x, y));
        assert_eq!(found.len(), 1, "one vertex at ({x}, {y})");
        close(found[0], expected, 1e-15, (x, y));
    }
}

#[test]
fn gamma_is_69645881_in_a_corner_and_90540692_at_a_re_entrant_one() {
    let bench = room(vec![Vect::<2>::new(0.4, 0.7), Vect::<2>::new(4.3, 3.4)]);
    for (x, y, gamma) in [(0.4, 0.7, 0.696_458_81), (4.3, 3.4, 0.905_406_92)] {
        let found = bench.gamma()[bench.at(Vect::<2>::new(x, y))];
        close(found, gamma, 5.1e-9, (x, y));
    }
}
