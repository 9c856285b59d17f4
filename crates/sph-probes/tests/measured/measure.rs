//! Measurements that scenes compose, on particles whose values are known.

use sph_core::{Store, Vect, fields};
use sph_neighbours::World;
use sph_probes::{Probe, ProbeColumn};

use super::common::{self, put};

const SPACING: f64 = 0.1;

/// Ten particles along x at 0.05, 0.15, …, with u = (x, −2x), masses 1 to 10, pressures 3x + 1; the first four are air.
fn world() -> World<2> {
    let place = |k: usize| Vect::from([(k as f64 + 0.5) * SPACING, 0.5]);
    let mut free = Store::new(10);
    let velocity = |x: Vect<2>| Vect::from([x[0], -2.0 * x[0]]);
    let pressure = |x: Vect<2>| 3.0 * x[0] + 1.0;
    let places = || (0..10).map(place);
    put(&mut free, fields::POSITION, places());
    put(&mut free, fields::VELOCITY, places().map(velocity));
    put(&mut free, fields::MASS, (1..=10).map(f64::from));
    put(&mut free, fields::PRESSURE, places().map(pressure));
    put(&mut free, fields::PHASE, (0..10).map(|k| u32::from(k > 3)));
    common::world(free, SPACING)
}

fn built(kind: &str, keys: &str) -> Box<dyn Probe<2>> {
    common::prepared(kind, keys, ["air", "water"])
}

fn measured(keys: &str) -> Vec<f64> {
    built("statistic", keys).measure(&world()).unwrap()
}

fn assert_near(found: &[f64], expected: &[f64]) {
    assert_eq!(found.len(), expected.len(), "{found:?}");
    for (a, b) in found.iter().zip(expected) {
        assert!((a - b).abs() < 1e-12 * b.abs().max(1.0), "{found:?}");
    }
}

#[test]
fn quantities_are_columns_components_coordinates_and_energies() {
    let speed = 0.5 * 5.0_f64.sqrt();
    let energy = |k: i32| 0.5 * f64::from(k + 1) * 5.0 * (0.05 + 0.1 * f64::from(k)).powi(2);
    let energy = (0..10).map(energy).sum();
    for (keys, expected) in [
        ("field = 'x'\nreduce = ['min', 'max']", &[0.05, 0.95][..]),
        ("field = 'velocity.y'", &[-1.0]),
        ("field = 'speed'", &[speed]),
        ("field = 'velocity'", &[speed]),
        ("field = 'kinetic_energy'\nreduce = ['sum']", &[energy]),
    ] {
        assert_near(&measured(keys), expected);
    }
}

#[test]
fn phases_and_bounds_choose_the_particles() {
    let bounds = "phase = 'air'\nabove = { x = 0.1 }\nbelow = { pressure = 2.0 }";
    let heavy = "weight = 'mass'\nphase = 'air'";
    for (keys, total) in [
        ("", 10.0),
        ("phase = 'air'", 4.0),
        (bounds, 2.0),
        (heavy, 10.0),
    ] {
        let keys = format!("field = 'pressure'\nreduce = ['total']\n{keys}");
        assert_near(&measured(&keys), &[total]);
    }
    let share = format!("field = 'x'\nreduce = ['share']\n{heavy}\nabove = {{ x = 0.3 }}");
    assert_near(&measured(&share), &[0.4]);
}

#[test]
fn weights_enter_means_and_quantiles() {
    let moments = (1..=10).map(|k| f64::from(k * k) - 0.5 * f64::from(k));
    let mean = moments.sum::<f64>() * 0.1 / 55.0;
    assert_near(&measured("field = 'x'\nweight = 'mass'"), &[mean]);
    let median = "field = 'x'\nreduce = []\nquantiles = [0.5]";
    assert_near(&measured(median), &[0.45]);
    assert_near(&measured(&format!("{median}\nweight = 'mass'")), &[0.65]);
}

#[test]
fn a_line_is_fitted_and_slices_are_curves() {
    assert_near(&measured("field = 'pressure'\nfit = 'x'"), &[2.5, 3.0, 0.0]);
    let keys = "field = 'pressure'\nreduce = ['mean', 'max']\nalong = 'x'";
    let probe = built("statistic", keys);
    let curves = probe.as_curves().expect("curves");
    assert_eq!(curves.curve_columns()[0], ProbeColumn::named("x", "m"));
    let rows = curves.curves(&world()).unwrap();
    assert_eq!(rows.len(), 5);
    assert_near(&rows[1], &[0.3, 1.9, 2.05]);
    assert_eq!(curves.curve_columns()[2].unit, "Pa");
}

#[test]
fn unknown_fields_are_named_with_the_nearest() {
    for (field, words) in [
        ("presure", "did you mean `pressure`"),
        ("velocity.z", "2 components"),
    ] {
        let probe = built("statistic", &format!("field = '{field}'"));
        let message = probe.measure(&world()).unwrap_err().to_string();
        assert!(message.contains(words), "{message}");
    }
}

/// Probes with names of their own are measurements.
#[test]
fn presets_measure_the_same() {
    let front = |keys: &str| built("front", &format!("axis = 'x'\n{keys}")).measure(&world());
    let own = measured("field = 'x'\nreduce = []\nquantiles = [0.7]");
    assert_near(&front("quantile = 0.7").unwrap(), &[own[0] + 0.5 * SPACING]);
    let back = front("direction = 'backward'\nphase = 'water'");
    assert_near(&back.unwrap(), &[0.4]);
}
