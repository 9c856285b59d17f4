//! Interfaces of a suspension, on rows of known concentrations.

use sph_core::{Store, Vect, fields};

use super::common::{built, fill, near, put, world};

const SPACING: f64 = 0.05;

/// By both probes, of twelve rows: six packed ones, four of a suspension, two clear.
fn heights(of: f64) -> [f64; 2] {
    let mut free = Store::<2>::new(36);
    let at = |n: u32| (f64::from(n) + 0.5) * SPACING;
    let place = |k: u32| Vect::from([at(k % 3), at(k / 3)]);
    let concentration = |k: u32| match k / 3 {
        0..6 => 0.6,
        6..10 => 0.1,
        _ => 0.0,
    };
    put(&mut free, fields::POSITION, (0..36).map(place));
    fill(&mut free, fields::MASS, 2.0);
    put(&mut free, fields::CONCENTRATION, (0..36).map(concentration));
    let world = world(free, SPACING);
    let level = |kind: &str, keys: String| built(kind, &keys).measure(&world).unwrap()[0];
    let keys = "field = 'concentration'\nweight = 'mass'\nreduce = []";
    [
        level("concentration-level", format!("concentration = {of}")),
        level("statistic", format!("{keys}\nlevels = [{of}]")),
    ]
}

/// Halfway between the concentrations of two rows the interface is halfway between them.
#[test]
fn interfaces_are_between_their_rows() {
    for (of, rows) in [(0.05, 10.0), (0.35, 6.0)] {
        for height in heights(of) {
            near(height, rows * SPACING);
        }
    }
    assert!(heights(0.7).iter().all(|height| height.is_nan()));
}
