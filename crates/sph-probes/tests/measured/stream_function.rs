//! The strength of a vortex whose stream function is known.

use std::f64::consts::PI;

use sph_core::{Registry, Store, Vect, fields};
use sph_neighbours::World;
use sph_probes::{Probe, ProbeEntry};

use super::common::{self, close, fill, put};

/// ψ = sin²(πx) sin²(πy)·¼ in the unit square: both velocities vanish on all sides.
fn world(rows: usize, scale: f64) -> World<2> {
    let spacing = 1.0 / rows as f64;
    let place = |k: usize| Vect::from([(k % rows) as f64 + 0.5, (k / rows) as f64 + 0.5]) * spacing;
    let positions: Vec<Vect<2>> = (0..rows * rows).map(place).collect();
    let u = |x: &Vect<2>| scale * 0.25 * PI * (PI * x[0]).sin().powi(2) * (2.0 * PI * x[1]).sin();
    let v = |x: &Vect<2>| -scale * 0.25 * PI * (PI * x[1]).sin().powi(2) * (2.0 * PI * x[0]).sin();
    let mut free = Store::new(positions.len());
    let velocity = |x: &Vect<2>| Vect::from([u(x), v(x)]);
    put(&mut free, fields::VELOCITY, positions.iter().map(velocity));
    fill(&mut free, fields::VOLUME, spacing * spacing);
    put(&mut free, fields::POSITION, positions);
    common::world(free, spacing)
}

fn probe(keys: &str) -> Result<Box<dyn Probe<2>>, String> {
    let registry = Registry::<ProbeEntry>::discovered().unwrap();
    let table = toml::from_str(keys).unwrap();
    let entry = registry.find("stream-function").unwrap();
    entry.build::<2>(&table).map_err(|e| e.to_string())
}

const SQUARE: &str = "box = [[0.0, 0.0], [1.0, 1.0]]";

fn errors(keys: &str, rows: [usize; 2]) -> [f64; 2] {
    let probe = probe(&format!("{SQUARE}\n{keys}")).unwrap();
    rows.map(|rows| {
        let found = probe.measure(&world(rows, -1.0)).unwrap();
        close(found[1], 0.5, 1e-9);
        close(found[2], 0.5, 0.5 / rows as f64);
        (found[0] - 0.25).abs() / 0.25
    })
}

#[test]
fn the_strength_converges_with_the_second_order_and_corrected_faster() {
    for (keys, least, most) in [("", 1.8, 0.02), ("corrections = 1", 1.9, 2e-3)] {
        let [coarse, fine] = errors(keys, [32, 64]);
        println!("{keys}: {coarse:.2e} {fine:.2e}");
        let order = (coarse / fine).log2();
        assert!(order > least && fine < most, "{coarse} {fine}");
    }
}

#[test]
fn an_empty_box_has_no_vortex_and_bad_keys_are_refused() {
    let away = probe("box = [[5.0, 5.0], [6.0, 6.0]]").unwrap();
    let found = away.measure(&world(8, 1.0)).unwrap();
    assert!(found.iter().all(|v| v.is_nan()), "{found:?}");
    for (keys, word) in [
        ("box = [[1.0, 0.0], [0.0, 1.0]]", "lower left corner first"),
        ("box = [[0.0, 0.0], [1.0, 1.0]]\ngrid = 0.0", "grid"),
        (
            "box = [[0.0, 0.0], [1.0, 1.0]]\ncorections = 1",
            "corrections",
        ),
        ("grid = 0.1", "`box`"),
    ] {
        let told = probe(keys).err().expect("refused");
        assert!(told.contains(word), "{keys}: {told}");
    }
}
