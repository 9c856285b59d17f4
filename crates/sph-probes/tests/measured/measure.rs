//! Measurements that scenes compose, on particles whose values are known.

use sph_core::{Registry, Role, Store, Vect, fields};
use sph_neighbours::World;
use sph_probes::{Probe, ProbeEntry};

const SPACING: f64 = 0.1;

/// Ten particles along x at 0.05, 0.15, …, with u = (x, −2x), masses 1 to 10, pressures 3x + 1; the first four are air.
fn world() -> World<2> {
    let place = |k: usize| Vect::from([(k as f64 + 0.5) * SPACING, 0.5]);
    let mut free = Store::new(10);
    free.add(fields::POSITION, Role::State);
    free.add(fields::VELOCITY, Role::State);
    free.add(fields::MASS, Role::State);
    free.add(fields::PRESSURE, Role::Derived);
    free.add(fields::PHASE, Role::State);
    let positions: Vec<Vect<2>> = (0..10).map(place).collect();
    let velocity = positions.iter().map(|x| Vect::from([x[0], -2.0 * x[0]]));
    *free.get_mut(fields::VELOCITY).unwrap() = velocity.collect();
    *free.get_mut(fields::MASS).unwrap() = (1..=10).map(f64::from).collect();
    *free.get_mut(fields::PRESSURE).unwrap() = positions.iter().map(|x| 3.0 * x[0] + 1.0).collect();
    *free.get_mut(fields::PHASE).unwrap() = (0..10).map(|k| u32::from(k > 3)).collect();
    *free.get_mut(fields::POSITION).unwrap() = positions;
    super::common::world(free, SPACING)
}

fn built(kind: &str, keys: &str) -> Box<dyn Probe<2>> {
    let registry = Registry::<ProbeEntry>::discovered().unwrap();
    let table = toml::from_str(keys).unwrap();
    let mut probe = registry.find(kind).unwrap().build::<2>(&table).unwrap();
    let names = ["air", "water"].map(String::from);
    probe.prepare(&super::common::scene(&names)).unwrap();
    probe
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
    assert_near(
        &measured("field = 'x'\nreduce = ['min', 'max']"),
        &[0.05, 0.95],
    );
    assert_near(&measured("field = 'velocity.y'"), &[-1.0]);
    let speed = 0.5 * 5.0_f64.sqrt();
    assert_near(&measured("field = 'speed'"), &[speed]);
    assert_near(&measured("field = 'velocity'"), &[speed]);
    let energy: f64 = (0..10)
        .map(|k| 0.5 * (k as f64 + 1.0) * 5.0 * (0.05 + 0.1 * k as f64).powi(2))
        .sum();
    assert_near(
        &measured("field = 'kinetic_energy'\nreduce = ['sum']"),
        &[energy],
    );
}

#[test]
fn phases_and_bounds_choose_the_particles() {
    let total = |keys: &str| measured(&format!("field = 'pressure'\nreduce = ['total']\n{keys}"));
    assert_near(&total(""), &[10.0]);
    assert_near(&total("phase = 'air'"), &[4.0]);
    assert_near(
        &total("phase = 'air'\nabove = { x = 0.1 }\nbelow = { pressure = 2.0 }"),
        &[2.0],
    );
    assert_near(&total("weight = 'mass'\nphase = 'air'"), &[10.0]);
    let share =
        "field = 'x'\nreduce = ['share']\nweight = 'mass'\nphase = 'air'\nabove = { x = 0.3 }";
    assert_near(&measured(share), &[0.4]);
}

#[test]
fn weights_enter_means_and_quantiles() {
    let mean = (1..=10)
        .map(|k| f64::from(k * k) - 0.5 * f64::from(k))
        .sum::<f64>()
        * 0.1
        / 55.0;
    assert_near(&measured("field = 'x'\nweight = 'mass'"), &[mean]);
    assert_near(
        &measured("field = 'x'\nreduce = []\nquantiles = [0.5]"),
        &[0.45],
    );
    assert_near(
        &measured("field = 'x'\nreduce = []\nquantiles = [0.5]\nweight = 'mass'"),
        &[0.65],
    );
}

#[test]
fn a_line_is_fitted_and_slices_are_curves() {
    assert_near(&measured("field = 'pressure'\nfit = 'x'"), &[2.5, 3.0, 0.0]);
    let probe = built(
        "statistic",
        "field = 'pressure'\nreduce = ['mean', 'max']\nalong = 'x'",
    );
    let curves = probe.as_curves().expect("curves");
    let names: Vec<_> = curves
        .curve_columns()
        .into_iter()
        .map(|c| (c.suffix, c.unit))
        .collect();
    assert_eq!(names[0], ("x".to_string(), "m"));
    let rows = curves.curves(&world()).unwrap();
    assert_eq!(rows.len(), 5);
    assert_near(&rows[1], &[0.3, 1.9, 2.05]);
    assert_eq!(curves.curve_columns()[2].unit, "Pa");
}

#[test]
fn unknown_fields_are_named_with_the_nearest() {
    let told = |field: &str| {
        let probe = built("statistic", &format!("field = '{field}'"));
        probe.measure(&world()).unwrap_err().to_string()
    };
    assert!(
        told("presure").contains("did you mean `pressure`"),
        "{}",
        told("presure")
    );
    assert!(
        told("velocity.z").contains("2 components"),
        "{}",
        told("velocity.z")
    );
}

/// Probes with names of their own are measurements.
#[test]
fn presets_measure_the_same() {
    let front = built("front", "axis = 'x'\nquantile = 0.7")
        .measure(&world())
        .unwrap();
    let own = measured("field = 'x'\nreduce = []\nquantiles = [0.7]");
    assert_near(&front, &[own[0] + 0.5 * SPACING]);
    let back = built(
        "front",
        "axis = 'x'\ndirection = 'backward'\nphase = 'water'",
    );
    assert_near(&back.measure(&world()).unwrap(), &[0.4]);
}
