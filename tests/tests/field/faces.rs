//! Open faces and outlets.

use sph_tests::{Says, below, close, near};

use crate::Field;

/// Density of the water of all inputs, kg/m³.
const WATER: f64 = 1000.0;

impl Field {
    /// A copy of an input with another law for its face `pump`.
    fn with_law(&self, input: &str, law: &str) {
        let text = self.read(&format!("{input}.toml"));
        let (before, rest) = text.split_once("[wall.pump.open-boundary").expect("a pump");
        let (_, after) = rest.split_once("[phase").expect("a phase");
        let law = format!("[wall.pump.open-boundary.{law}\n[phase");
        self.write("other.toml", &(before.to_owned() + &law + after));
    }

    /// Remarks of the last run that name a face.
    fn remarks(&self, face: &str) -> Vec<String> {
        let summary = self.summary();
        let all = summary["warnings"].as_array().expect("a list").iter();
        let texts = all.map(|w| w.as_str().expect("a text").to_owned());
        texts
            .filter(|text| text.contains(&format!("`{face}`")))
            .collect()
    }
}

/// A column of water goes down with the velocity of a pump. What the probe counts is the mass that was asked for; the particles
/// that have gone are the same but for a row, and so is the level.
fn drained(input: &str, section: f64, spacing: f64, rate: f64, end: f64, more: &str) {
    let field = Field::new();
    let down = -rate / section;
    let along = ["0.0", "0.0,0.0"][usize::from(input.ends_with("3d"))];
    let series = field.ran(
        input,
        &format!(
            "--set wall.pump.open-boundary.flow-rate.rate=-{rate} --set body.water.velocity=[{along},{down}] \
             --set run.end={end} --set numerics.spacing={spacing} {more}"
        ),
    );
    let asked = WATER * rate * end;
    let (_, left) = series.at("pump.left", end);
    let (_, gone) = series.at("open.pump.water", end);
    let sunk = (series.column("level")[0] - series.at("level", end).1) * section * WATER;
    println!(
        "{input} {rate} {spacing} {more}: {left} and {gone} kg for {asked}, by the level {sunk}"
    );
    assert!((left / asked - 1.0).abs() < 0.005, "{left} kg for {asked}");
    let row = WATER * section * spacing;
    assert!((gone - asked).abs() < 0.8 * row, "{gone} kg for {asked}");
    close(sunk, asked, 0.5 * row, "kg by the level");
    let said = field.remarks("pump");
    assert!(said.is_empty(), "{said:?}");
}

#[test]
fn a_pump_takes_out_what_it_is_asked_for() {
    drained("drain-duct", 0.1, 0.01, 0.05, 0.4, "");
    drained("drain-duct", 0.1, 0.01, 0.1, 0.2, "");
}

#[test]
fn a_pump_takes_out_what_it_is_asked_for_at_any_speed_of_sound() {
    drained("drain-duct", 0.1, 0.02, 0.02, 1.2, "");
    let fast = "--set phase.water.speed_of_sound=60";
    drained("drain-duct", 0.1, 0.02, 0.05, 0.5, fast);
}

#[test]
fn a_pump_takes_out_what_it_is_asked_for_in_space() {
    drained("drain-duct-3d", 0.01, 0.02, 0.005, 0.6, "");
}

/// The rate comes in through what has fluid before it, and goes out below the level. What the flume stores is less than half a
/// row.
#[test]
fn a_flow_rate_comes_into_a_flume_below_its_surface() {
    let field = Field::new();
    let series = field.ran("channel2", "--set run.end=2.5");
    let [(_, came), (_, went)] = ["in.entered", "out.left"].map(|column| series.at(column, 2.5));
    println!(
        "{came} kg came in and {went} went out; at most {} m/s",
        series.largest("largest_speed")
    );
    assert!((came / 75.0 - 1.0).abs() < 0.005, "{came} kg for 75");
    close(came, went, 5.0, "kg that came in and went out");
    for gauge in ["up", "down"] {
        let level = series.largest(gauge);
        assert!(level < 0.1 + 0.005, "`{gauge}`: {level} m");
    }
}

/// A pump draws air when its tank is empty. It has its rate until the water on the floor is 1.5 (q²/g)^(1/3) = 60 mm deep, at
/// 1.44 s: no more than q = 0.025 m²/s runs over either edge then. Nobody is faster than a fall from the level to the
/// pump, and the run ends and says what is missing.
#[test]
fn a_pump_that_draws_air_idles() {
    let field = Field::new();
    let series = field.ran("drain-pipe", "");
    let (time, left) = series.at("pump.left", 1.4);
    // A row of 1 kg waits behind the face for a fifth of its passage.
    close(left, 50.0 * time, 0.25 * time + 0.2, "kg that have left");
    let fastest = series.largest("largest_speed");
    let fall = (2.0 * 9.81 * 0.5_f64).sqrt();
    assert!(fastest < fall, "{fastest} m/s");
    let said = field.remarks("pump");
    println!("{said:?}, {fastest} m/s");
    assert_eq!(said.len(), 1, "{said:?}");
    assert!(said[0].contains("% less") && said[0].contains("no fluid was before it, first at"));
    let first = said[0]
        .split("first at ")
        .nth(1)
        .and_then(|s| s.strip_suffix(" s"));
    let first: f64 = first.expect("a time").parse().expect("a number");
    assert!((1.44..2.5).contains(&first), "{first} s");
    // The tank held 110 kg, and a row may lie on its floor.
    let passed = -field.summary()["open_boundaries"]["pump"]["passed_volume"]
        .as_f64()
        .expect("m²");
    assert!((0.107..0.111).contains(&passed), "{passed} m²");
}

/// A pipe that is dry at the start fills, and has its rate from then on, as long as 60 mm of water stand on the floor.
#[test]
fn a_pump_with_a_dry_pipe_fills_it() {
    let field = Field::new();
    let half = "--set body.water.box=[[0.0,0.0],[0.3,0.3]] --set run.end=1.1";
    let series = field.ran("drain-pipe", half);
    let [(from, before), (to, after)] = [0.5, 1.1].map(|time| series.at("pump.left", time));
    let (passed, asked) = (after - before, 50.0 * (to - from));
    println!("{passed} kg for {asked} once the pipe is full");
    near(passed, asked, 0.01, "kg");
    assert!(field.remarks("pump")[0].contains("no fluid was before it, first at 0.000 s"));
}

/// Laws that ask for no rate run dry, too: all goes, the run ends, and one line says so.
#[test]
fn faces_of_any_law_run_dry() {
    let field = Field::new();
    for law in [
        "pressure]\npressure = 0.0",
        "outflow]\nmemory = \"0.1 s\"",
        "level]\nlevel = 0.0",
    ] {
        field.with_law("drain-duct", law);
        let series = field.ran("other", "--set run.end=1.0 --set numerics.spacing=0.02");
        let summary = field.summary();
        assert_eq!(summary["status"], "done", "{law}");
        assert_eq!(summary["particles"], 0, "{law}");
        let said = field.remarks("pump");
        assert_eq!(said.len(), 1, "{law}: {said:?}");
        said[0].says("is dry, first at");
        // A column of 0.4 m falls with its first velocity on: nobody is faster than that.
        let fall = (0.5_f64.powi(2) + 2.0 * 9.81 * 0.4).sqrt() + 0.2;
        assert!(series.largest("largest_speed") < fall, "{law}");
    }
}

/// A wave that comes to a dry pump and back is taken as far as it is there.
#[test]
fn a_wave_that_comes_back_finds_the_pump() {
    let field = Field::new();
    let series = field.ran("dam-pump", "");
    let mut pairs = series.column("pump.left").windows(2);
    assert!(pairs.all(|w| w[1] > w[0] - 0.5), "mass came back");
    let (_, left) = series.at("pump.left", 2.0);
    let fastest = series.largest("largest_speed");
    println!("{left} kg, {fastest} m/s");
    assert!(left > 5.0 && left < 20.2, "{left} kg");
    below(fastest, 2.0 * (9.81 * 0.2_f64).sqrt() + 0.3, "m/s");
}
