//! Warnings, estimates and advice.

use serde_json::Value as Json;
use sph_tests::{DAM_BREAK, Says, bench};

use super::Field;

/// A tank at rest that names no numerics but its spacing.
const TANK: &str = r#"
title = "a tank"
dimension = 2
run.end = 0.05
numerics = { spacing = 0.02, gravity = [0.0, -9.81] }
wall.tank = { polyline = [[0.0, 0.4], [0.0, 0.0], [0.4, 0.0], [0.4, 0.4]] }
phase.water = { density = 1000.0, rheology.newtonian = { viscosity = 1e-3 } }
body.water = { phase = "water", box = [[0.0, 0.0], [0.4, 0.2]], pressure = "hydrostatic" }
output.every = 0.05
probe.p = { kind = "range", field = "pressure" }
probe.of-dry = { kind = "range", field = "density", scale = 1000.0 }
"#;

/// Warnings and advice of a check or a run, one under the other.
fn said(told: &Json) -> String {
    let lists = ["warnings", "advice"].map(|key| told[key].as_array());
    let lines = lists.into_iter().flatten().flatten();
    lines
        .filter_map(Json::as_str)
        .collect::<Vec<_>>()
        .join("\n")
}

fn json(text: &str) -> Json {
    serde_json::from_str(text).expect("JSON")
}

#[test]
fn defaults_draw_no_remark_on_sound_and_slow_sound_does() {
    let bench = bench!(TANK);
    let told = bench.done("check scene.toml --json").out;
    assert!(!said(&json(&told)).contains("Mach"), "{told}");
    let slow = "--set phase.water.speed_of_sound=7";
    let told = bench.done(&format!("check scene.toml --json {slow}")).out;
    // √(g · 0.2 m) = 1.4 m/s.
    let mach = "the Mach number of `water` is 0.2";
    assert!(said(&json(&told)).contains(mach), "{told}");

    let bench = bench!(DAM_BREAK);
    let run = |more: &str| {
        bench.done(&format!("run scene.toml --quiet --out r {more}"));
        said(&json(&bench.read("r/summary.json")))
    };
    let advised = run("");
    assert!(!advised.contains("of the speed of sound"), "{advised}");
    // The column falls with up to 2√(gH) = 4 m/s, half of this sound.
    let advised = run("--set phase.water.speed_of_sound=8");
    advised.says("of the mass was faster than 0.2");
}

/// Advice that is followed is silent, and its contrary is not given.
#[test]
fn a_slower_sound_is_advised_as_far_as_it_may_fall_and_then_no_further() {
    let bench = bench!(TANK);
    let run = |sound: f64| {
        let set = format!("--set phase.water.speed_of_sound={sound}");
        bench.done(&format!("run scene.toml --quiet --out r {set}"));
        said(&json(&bench.read("r/summary.json")))
    };
    let advised = run(100.0);
    let factor = advised
        .split_once("`speed_of_sound`")
        .and_then(|(_, rest)| rest.split_once("here for a factor of "))
        .and_then(|(_, rest)| rest.split_once(';')?.0.parse::<f64>().ok());
    let factor = factor.unwrap_or_else(|| panic!("no factor: {advised}"));
    // The depth of 0.2 m compresses by gH/c² = 1 % at 14 m/s.
    assert!((4.0..9.0).contains(&factor), "{advised}");
    let advised = run(100.0 / factor);
    assert!(!advised.contains("sound"), "{advised}");
}

#[test]
fn the_scene_of_new_has_no_remark_on_itself() {
    let bench = bench!();
    bench.done("new pool");
    let told = bench.done("check pool.toml --json").out;
    assert_eq!(said(&json(&told)), "", "{told}");
    let told = bench.done("run pool.toml --json").out;
    assert_eq!(said(&json(&told)), "", "{told}");
}

#[test]
fn a_phase_at_rest_has_not_the_speed_of_another() {
    let told = bench!().done("check elastic-beam --json").out;
    assert!(!said(&json(&told)).contains("Mach"), "{told}");
}

/// Simulates `end` seconds on one thread; the estimates of steps and seconds over what they were.
fn estimated(field: &Field, input: &str, more: &str) -> [f64; 2] {
    let told = field.check(input, &format!("--json --threads 1 {more}"));
    let estimate = &json(&told.out)["estimate"];
    field.ran(input, &format!("--threads 1 {more}"));
    let summary = field.summary();
    let over = |told: &Json, factor: f64, key: &str| {
        let taken = summary[key].as_f64().expect("a number");
        told.as_f64().expect("an estimate") * factor / taken
    };
    [
        over(&estimate["steps"], 1.0, "steps"),
        over(&estimate["hours"], 3600.0, "wall_seconds"),
    ]
}

#[test]
fn estimates_hold_for_implicit_viscosity_and_for_bodies_in_space() {
    let field = Field::new();
    let ball = "--set numerics.spacing=0.08 --set wall.ball.mover.rigid-body.density=500 --set run.end=0.4";
    let grease = "--set numerics.spacing=0.01";
    for (input, more) in [("grease", grease), ("neutral-ball", ball)] {
        let [steps, seconds] = estimated(&field, input, more);
        assert!((0.5..2.0).contains(&steps), "{input}: steps {steps:.2}");
        // The clock is that of a machine with other work to do.
        assert!((0.25..4.0).contains(&seconds), "{input}: time {seconds:.2}");
    }
}

#[test]
fn steps_of_stiff_friction_are_told_with_their_remedy() {
    let field = Field::new();
    let implicit = field.read("grease.toml");
    let explicit = implicit.replace("[implicit-viscosity.backward-euler]\n", "");
    assert_ne!(implicit, explicit);
    field.write("explicit.toml", &explicit);
    for viscosity in ["1e6", "2e4"] {
        let more = format!(
            "--json --set phase.grease.rheology.herschel-bulkley.largest_viscosity={viscosity}"
        );
        let told = said(&json(&field.check("explicit", &more).out));
        told.says("`viscosity` bounds the first step | [implicit-viscosity.backward-euler]");
    }
    field.ran("grease", "--set numerics.spacing=0.01 --set run.end=0.2");
    let told = said(&field.summary());
    assert!(!told.contains("times as fast"), "{told}");
}

#[test]
fn a_plugin_is_shown_where_a_scene_names_it_with_values_of_its_types() {
    let bench = bench!();
    let told = bench.done("plugins mover rigid-body").out;
    told.says(
        "[wall.NAME.mover.rigid-body] | # free = [\"x\"] | # angular_velocity = [1.0]   # rad/s",
    );
    let told = bench.done("plugins open-boundary flow-rate").out;
    told.says("[wall.NAME.open-boundary.flow-rate]");
}

#[test]
fn a_range_has_the_unit_of_its_field() {
    let bench = bench!(TANK);
    bench.done("run scene.toml --quiet --out r");
    let series = bench.read("r/series.csv");
    let head = series.lines().next().expect("a head");
    head.says("p.min[Pa] | p.max[Pa] | of-dry.max[1]");
}
