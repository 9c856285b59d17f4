//! Surfaces and failure lines against drawn ones, on particles whose places are known.

use sph_core::{Store, Vect, fields};
use sph_neighbours::World;
use sph_probes::Probe;

use super::common::{self, near, put};

const SPACING: f64 = 0.05;

/// Twenty columns; the top of column k is at slope · x, what lies above half of that has moved.
fn world(slope: f64) -> World<2> {
    let mut positions = Vec::new();
    let mut moved = Vec::new();
    for column in 0..20 {
        let x = (f64::from(column) + 0.5) * SPACING;
        let top = 1.0 + slope * x;
        for row in 0..10 {
            let y = top - (f64::from(row) + 0.5) * SPACING;
            positions.push(Vect::from([x, y]));
            let way = if y > top - 5.0 * SPACING { 0.01 } else { 1e-4 };
            moved.push(Vect::from([0.6, -0.8]) * way);
        }
    }
    let mut free = Store::new(positions.len());
    put(&mut free, fields::POSITION, positions);
    put(&mut free, fields::DISPLACEMENT, moved);
    common::world(free, SPACING)
}

fn probe(keys: &str) -> Box<dyn Probe<2>> {
    common::built("line", &format!("file = \"line.csv\"\n{keys}"))
}

fn measured(keys: &str, world: &World<2>, rows: Vec<[f64; 2]>) -> Vec<f64> {
    let mut probe = probe(keys);
    probe.load_reference(rows).unwrap();
    probe.measure(world).unwrap()
}

#[test]
fn a_straight_surface_is_met_and_a_shift_is_its_distance() {
    let at = |x: f64, shift: f64| [x, 1.0 + 0.3 * x + shift];
    // Between the first top and the last.
    let place = |k: i32| 0.05 * f64::from(k) + 0.01;
    let line = |shift| (2..19).map(|k| at(place(k), shift)).collect();
    let found = measured("", &world(0.3), line(0.0));
    assert!(found[0] < 1e-12 && found[1] == 1.0, "{found:?}");
    let found = measured("of = \"surface\"", &world(0.3), line(0.02));
    near(found[0], 0.02);
    near(found[2], 0.02 / (1.0_f64 + 0.3 * 0.3).sqrt());
}

#[test]
fn the_failure_line_is_over_what_has_hardly_moved() {
    // Five rows lie above it.
    let line: Vec<[f64; 2]> = (1..19).map(|k| [0.05 * f64::from(k), 0.75]).collect();
    let keys = |moved: &str| format!("of = \"failure\"\nmoved = \"{moved}\"");
    assert!(probe(&keys("1 mm")).needs().displacement && !probe("").needs().displacement);
    let failed = |moved: &str| measured(&keys(moved), &world(0.0), line.clone());
    let [found, all, none] = ["1 mm", "20 mm", "10 um"].map(failed);
    assert!(found[0] < 1e-12 && found[1] == 1.0, "{found:?}");
    near(all[0], 0.25);
    assert!(none[0].is_nan() && none[1] == 0.0, "{none:?}");
}

/// Particles that slid apart leave columns of one spacing empty, but for what lies deeper.
#[test]
fn gaps_between_the_highest_are_bridged() {
    let mut world = world(0.0);
    for x in world.free.get_mut(fields::POSITION).unwrap() {
        x[0] *= if x[1] > 0.9 { 1.3 } else { 1.0 };
    }
    let line = (2..18).map(|k| [0.05 * f64::from(k), 1.0]).collect();
    let found = measured("", &world, line);
    assert!(found[0] < 1e-12 && found[1] == 1.0, "{found:?}");
}

#[test]
fn points_without_a_column_lower_the_share_alone() {
    let line = vec![[0.5, 1.0], [1.5, 0.0], [-0.5, 0.0], [0.99, 1.0]];
    let found = measured("", &world(0.0), line);
    assert!(found[0] < 1e-12 && found[1] == 0.5, "{found:?}");
}

#[test]
fn invalid_lines_are_refused() {
    let mut probe = probe("");
    assert_eq!(probe.file(), Some("line.csv"));
    assert!(probe.load_reference(Vec::new()).is_err());
    assert!(probe.load_reference(vec![[0.0, f64::NAN]]).is_err());
}
