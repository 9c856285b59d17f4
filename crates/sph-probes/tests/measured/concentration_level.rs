//! Interfaces of a suspension, on rows of known concentrations.

use sph_core::{Registry, Role, Store, Vect, fields};
use sph_probes::ProbeEntry;

const SPACING: f64 = 0.05;

/// Twelve rows: six packed ones, four of a suspension, two clear.
fn height(of: f64) -> f64 {
    let rows: Vec<u32> = (0..36).collect();
    let mut free = Store::new(rows.len());
    for field in [fields::MASS, fields::CONCENTRATION] {
        free.add(field, Role::State);
    }
    free.add(fields::POSITION, Role::State);
    let at = |n: u32| (f64::from(n) + 0.5) * SPACING;
    *free.get_mut(fields::POSITION).unwrap() = rows
        .iter()
        .map(|k| Vect::from([at(k % 3), at(k / 3)]))
        .collect();
    free.get_mut(fields::MASS).unwrap().fill(2.0);
    *free.get_mut(fields::CONCENTRATION).unwrap() = rows
        .iter()
        .map(|k| match k / 3 {
            0..6 => 0.6,
            6..10 => 0.1,
            _ => 0.0,
        })
        .collect();
    let keys = format!("concentration = {of}");
    let registry = Registry::<ProbeEntry>::discovered().unwrap();
    let entry = registry.find("concentration-level").unwrap();
    let probe = entry.build::<2>(&toml::from_str(&keys).unwrap()).unwrap();
    probe.measure(&super::common::world(free, SPACING)).unwrap()[0]
}

/// Halfway between the concentrations of two rows the interface is halfway between them.
#[test]
fn interfaces_are_between_their_rows() {
    assert!((height(0.05) - 10.0 * SPACING).abs() < 1e-12);
    assert!((height(0.35) - 6.0 * SPACING).abs() < 1e-12);
    assert!(height(0.7).is_nan());
}
