//! Surfaces and failure lines against drawn ones, on particles whose places are known.

use sph_core::{Registry, Role, Store, Vect, fields};
use sph_neighbours::World;
use sph_probes::{Probe, ProbeEntry};

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
    free.add(fields::POSITION, Role::State);
    free.add(fields::DISPLACEMENT, Role::State);
    *free.get_mut(fields::POSITION).unwrap() = positions;
    *free.get_mut(fields::DISPLACEMENT).unwrap() = moved;
    super::common::world(free, SPACING)
}

fn probe(keys: &str) -> Box<dyn Probe<2>> {
    let registry = Registry::<ProbeEntry>::discovered().unwrap();
    let table = toml::from_str(&format!("file = \"line.csv\"\n{keys}")).unwrap();
    registry.find("line").unwrap().build::<2>(&table).unwrap()
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
    let line = |shift| {
        (2..19)
            .map(|k| at(0.05 * f64::from(k) + 0.01, shift))
            .collect()
    };
    let found = measured("", &world(0.3), line(0.0));
    assert!(found[0] < 1e-12 && found[1] == 1.0, "{found:?}");
    let found = measured("of = \"surface\"", &world(0.3), line(0.02));
    assert!((found[0] - 0.02).abs() < 1e-12, "{found:?}");
    let across = 0.02 / (1.0_f64 + 0.3 * 0.3).sqrt();
    assert!((found[2] - across).abs() < 1e-12, "{found:?}");
}

#[test]
fn the_failure_line_is_over_what_has_hardly_moved() {
    // Five rows lie above it.
    let line: Vec<[f64; 2]> = (1..19).map(|k| [0.05 * f64::from(k), 0.75]).collect();
    let keys = "of = \"failure\"\nmoved = \"1 mm\"";
    assert!(probe(keys).needs().displacement && !probe("").needs().displacement);
    let found = measured(keys, &world(0.0), line.clone());
    assert!(found[0] < 1e-12 && found[1] == 1.0, "{found:?}");
    let all = measured(
        "of = \"failure\"\nmoved = \"20 mm\"",
        &world(0.0),
        line.clone(),
    );
    assert!((all[0] - 0.25).abs() < 1e-12, "{all:?}");
    let none = measured("of = \"failure\"\nmoved = \"10 um\"", &world(0.0), line);
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
