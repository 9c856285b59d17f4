//! Probes of a movable bed, on particles whose places are known.

use sph_core::{Store, Vect, fields};
use sph_neighbours::World;
use sph_probes::Probe;

use super::common::{self, fill, near, put};

const SPACING: f64 = 0.05;
/// Top of the bed and of the water at x = 0, and their slopes.
const BED: f64 = 0.5;
const WATER: f64 = 0.9;
const SLOPE: f64 = 0.2;

/// Twenty columns of ten grains and eight water particles. Left of the middle the two upper rows of
/// grains move at 0.3 m/s, all other grains at 0.1 m/s, the water at 1 m/s.
fn world() -> World<2> {
    let mut rows = Vec::new();
    for column in 0..20 {
        let x = (f64::from(column) + 0.5) * SPACING;
        let down = |top: f64, row: u32| top + SLOPE * x - (f64::from(row) + 0.5) * SPACING;
        for row in 0..10 {
            let speed = if x < 0.5 && row < 2 { 0.3 } else { 0.1 };
            rows.push(([x, down(BED, row)], 0, speed, 5.0));
        }
        rows.extend((0..8).map(|row| ([x, down(WATER, row)], 1, 1.0, 2.5)));
    }
    let mut free = Store::new(rows.len());
    let row = || rows.iter().copied();
    let velocity = |speed: f64| Vect::from([0.6, -0.8]) * speed;
    let still = |[_, y]: [f64; 2]| 1000.0 * 10.0 * (2.0 - y);
    put(&mut free, fields::POSITION, row().map(|r| r.0.into()));
    put(&mut free, fields::PHASE, row().map(|r| r.1));
    put(&mut free, fields::VELOCITY, row().map(|r| velocity(r.2)));
    put(&mut free, fields::MASS, row().map(|r| r.3));
    fill(&mut free, fields::VOLUME, SPACING * SPACING);
    put(&mut free, fields::PORE_PRESSURE, row().map(|r| still(r.0)));
    World {
        gravity: Vect::from([0.0, -10.0]),
        steady_gravity: Vect::from([0.0, -10.0]),
        ..common::world(free, SPACING)
    }
}

fn probe(kind: &str, keys: &str) -> Box<dyn Probe<2>> {
    common::prepared(kind, keys, ["sand", "water"])
}

fn measured(kind: &str, keys: &str) -> Vec<f64> {
    probe(kind, keys).measure(&world()).unwrap()
}

#[test]
fn the_three_curves_are_the_lines_they_were_made_from() {
    let bed = probe("bed-lines", "phase = \"sand\"");
    let curves = bed.as_curves().unwrap();
    let names = curves.curve_columns().into_iter().map(|c| c.suffix);
    assert!(names.eq(["x", "surface", "interface", "limit"]));
    let rows = curves.curves(&world()).unwrap();
    assert_eq!(rows.len(), 10, "a row for two spacings");
    // Between the first and the last particle of its line and clear of the steps in the middle.
    let inner = |x: f64| (0.1..0.4).contains(&x) || (0.6..0.9).contains(&x);
    let mut counted = 0;
    for row in rows.iter().filter(|row| inner(row[0])) {
        let moving = if row[0] < 0.5 { 2.0 * SPACING } else { 0.0 };
        let exact = [WATER, BED, BED - moving].map(|top| top + SLOPE * row[0]);
        for (found, exact) in row[1..].iter().zip(exact) {
            near(*found, exact);
        }
        counted += 1;
    }
    assert_eq!(counted, 6);
}

#[test]
fn a_moving_bed_is_weighed_with_its_lowest_point() {
    let found = measured("bed-lines", "phase = \"sand\"");
    near(found[0], 20.0 * 5.0);
    // The lower edge of the second row at the first particle.
    let lowest = BED - 2.0 * SPACING + SLOPE * 0.5 * SPACING;
    near(found[1], lowest);
    let all = measured("bed-lines", "phase = \"sand\"\nthreshold = 0.05");
    near(all[0], 200.0 * 5.0);
    let none = measured("bed-lines", "phase = \"sand\"\nthreshold = 0.5");
    assert!(none[0] == 0.0 && none[1].is_nan(), "{none:?}");
}

#[test]
fn a_line_compares_the_limit_with_a_drawn_one() {
    let keys = "file = \"f.csv\"\nof = \"limit\"\nphase = \"sand\"";
    let rms = |shift: f64, end: f64| {
        let mut line = probe("line", keys);
        let row = |k: i32| {
            let x = 0.05 + (end - 0.05) * f64::from(k) / 20.0;
            [x, BED - 2.0 * SPACING + SLOPE * x + shift]
        };
        line.load_reference((0..=20).map(row).collect()).unwrap();
        line.measure(&world()).unwrap()
    };
    let found = rms(0.0, 0.42);
    assert!(found[0] < 1e-12 && found[1] == 1.0, "{found:?}");
    let found = rms(0.02, 0.42);
    near(found[0], 0.02);
}

#[test]
fn eroded_mass_is_what_is_beyond_and_above() {
    // Tops of the grains' columns are at 0.5 + 0.2 x: at 0.6 for x = 0.625.
    let (out, risen) = (3.0 * 10.0 * 5.0, 5.0 * 5.0);
    for (keys, exact) in [
        ("level = 0.599\nbeyond = 0.85", [out, risen, out + risen]),
        (
            "level = 10\nbeyond = 0.1\ndirection = \"backward\"",
            [100.0, 0.0, 100.0],
        ),
        ("level = 10", [0.0; 3]),
    ] {
        let found = measured("eroded-mass", &format!("phase = \"sand\"\n{keys}"));
        assert_eq!(found, exact);
    }
}

#[test]
fn a_pore_pressure_that_is_that_of_still_water_is_met() {
    // In the sand, at the interface and in the water: the particles' places and weights do not matter.
    for at in [[0.5, 0.3], [0.31, 0.55], [0.52, 0.77]] {
        let found = measured("pore-pressure", &format!("at = {at:?}"))[0];
        near(found / (1000.0 * 10.0 * (2.0 - at[1])), 1.0);
    }
    let dry = measured("pore-pressure", "at = [0.5, 1.5]");
    assert_eq!(dry, [0.0]);
}
