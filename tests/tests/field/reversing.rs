//! Flows through open faces that turn round.

use sph_tests::{Says, near};

use crate::Field;

/// Momentum along the channel, kg m/s per metre, of 2000 kg/m that go with the inlet as a whole.
fn as_a_whole(velocity: f64) -> f64 {
    2000.0 * velocity
}

/// What is in the channel at the end of a run, and the least and largest density there, over what fills it.
fn held(field: &Field, spacing: f64) -> [f64; 3] {
    let series = field.series();
    let last = |name: &str| series.last(name);
    let summary = field.summary();
    let particles = summary["particles"].as_f64().expect("particles");
    let mass = 1000.0 * spacing * spacing * particles + last("i.held") + last("o.held");
    let books = 2000.0 + last("i.entered") - last("i.left") + last("o.entered") - last("o.left");
    near(mass, books, 1e-9, "kg");
    [
        mass / 2000.0,
        last("least_density_ratio"),
        last("largest_density_ratio"),
    ]
}

/// The inlet goes from 0.5 to −0.5 m/s and back within 0.2 s: the water in a full channel follows it, and so does the
/// outlet.
#[test]
fn an_outlet_lets_in_while_the_inlet_takes_out() {
    let field = Field::new();
    let spacing = 0.0625;
    let series = field.ran("reverse-outflow", "--threads 1");
    assert_eq!(field.summary()["status"], "done");
    // A part e^(−1 s/0.5 s) of what the outlet's means lag behind is left at the end of each part.
    for (time, velocity) in [(1.0, 0.5), (2.2, -0.5), (4.0, 0.5)] {
        let (_, found) = series.at("momentum.x", time);
        let asked = as_a_whole(velocity);
        near(found, asked, 0.07, &format!("kg m/s at {time} s"));
    }
    let [mass, least, largest] = held(&field, spacing);
    assert!((mass - 1.0).abs() < 0.01, "{mass} of the water");
    assert!(least > 0.99 && largest < 1.01, "{least} to {largest}");
}

/// The same within 1.2 s, when the tension is that of the water's mass and not that of its sound, and upside down.
#[test]
fn a_slow_turn_and_a_start_backwards_do_the_same() {
    let field = Field::new();
    for (course, turned) in [
        ("[[0,1],[0.6,1],[1.8,-1],[9,-1]]", -0.5),
        ("[[0,-1],[0.8,-1],[1.2,1],[9,1]]", 0.5),
    ] {
        let set = format!(
            "--threads 1 --set run.end=3 --set wall.i.open-boundary.velocity-inlet.over_time={course}"
        );
        let series = field.ran("reverse-outflow", &set);
        let (_, found) = series.at("momentum.x", 3.0);
        let asked = as_a_whole(turned);
        near(found, asked, 0.1, "kg m/s");
        let [mass, least, largest] = held(&field, 0.0625);
        assert!((mass - 1.0).abs() < 0.01, "{mass} of the water");
        assert!(least > 0.98 && largest < 1.02, "{least} to {largest}");
    }
}

/// Only full boxes have their pressures raised: water under a free surface is pushed back by its weight.
#[test]
fn the_pressures_of_a_full_box_alone_are_raised() {
    let field = Field::new();
    let warnings = |more: &str| {
        let check = field
            .check("reverse-outflow", &format!("--json --threads 1 {more}"))
            .ended(0);
        let told = check.json();
        told["warnings"].to_string()
    };
    // ρcΔu is 1000 kg/m³ · 20 m/s · 1 m/s, and half as much again.
    warnings("").says("3.000e4 Pa higher");
    let own = "--set phase.w.equation-of-state.tait.background_pressure=1e4";
    let half = "--set body.w.box=[[0,0],[2,0.5]]";
    let steady = "--set wall.i.open-boundary.velocity-inlet.over_time=[[0,0],[1,1],[9,1]]";
    for more in [own, half, steady] {
        warnings(more).lacks("Pa higher");
    }
}

/// Light fluid above water passes with its own sound: births never are without mass in their volume.
#[test]
fn two_faces_that_turn_round_pass_two_layers() {
    let field = Field::new();
    field.ran("reverse-stratified", "--threads 1");
}
