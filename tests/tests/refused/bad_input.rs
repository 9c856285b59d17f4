//! Bad input: the place of the mistake, what was expected, the exit code, and nothing written.

use std::time::{Duration, Instant};

use sph_tests::{Bench, DAM_BREAK, Outcome};

const PROGRAM: &str = env!("CARGO_BIN_EXE_sph-under-test");

/// Replaces a part of the dam break; the part must be there.
fn with(from: &str, to: &str) -> String {
    assert!(DAM_BREAK.contains(from), "the scene lost `{from}`");
    DAM_BREAK.replacen(from, to, 1)
}

fn says(outcome: &Outcome, words: &[&str]) {
    for word in words {
        assert!(
            outcome.err.contains(word),
            "no `{word}` in\n{}",
            outcome.err
        );
    }
}

/// The scene is refused with code 2, at the line that contains `line`, and leaves no file.
fn refused(scene: &str, line: &str, words: &[&str]) {
    let bench = Bench::with(PROGRAM, scene);
    let number = 1 + scene
        .lines()
        .position(|l| l.contains(line))
        .expect("the line is there");
    for command in ["run", "check"] {
        let outcome = bench.call(&format!("{command} scene.toml"));
        assert_eq!(outcome.code, Some(2), "{}", outcome.err);
        says(&outcome, words);
        says(&outcome, &[&format!("scene.toml:{number}:")]);
        nothing_written(&bench);
    }
    // The same for a program.
    let outcome = bench.call("check scene.toml --json");
    let told: serde_json::Value = serde_json::from_str(&outcome.out).expect("JSON");
    let at = |d: &serde_json::Value| d["line"] == number && d["file"] == "scene.toml";
    assert!(
        told.as_array().expect("an array").iter().any(at),
        "{told:#}"
    );
}

fn nothing_written(bench: &Bench) {
    let entries = std::fs::read_dir(bench.folder()).expect("the folder");
    let names: Vec<_> = entries.map(|e| e.expect("an entry").file_name()).collect();
    assert_eq!(names, ["scene.toml"], "something was written");
}

#[test]
fn an_unknown_plugin() {
    let scene = with(
        "[smoother.brezzi-pitkaranta]",
        "[smoother.brezi-pitkaranta]",
    );
    let words = [
        "no smoother called `brezi-pitkaranta`",
        "did you mean `brezzi-pitkaranta`",
    ];
    refused(&scene, "[smoother.", &words);
}

#[test]
fn a_renormalised_surface_without_density_sums() {
    let tables = "[surface.renormalised]\n[formulation.colagrossi-landrini]\n";
    let scene = format!("{DAM_BREAK}\n{tables}").replace("[formulation.hu-adams]\n", "");
    refused(&scene, "[surface.renormalised]", &["densities are no sums"]);
}

#[test]
fn a_misspelt_key() {
    let scene = with("spacing = 0.02", "spcing = 0.02");
    refused(
        &scene,
        "spcing",
        &["numerics.spcing", "did you mean `spacing`"],
    );
}

#[test]
fn a_misspelt_parameter_of_a_plugin() {
    let scene = with("strength = 0.04", "strenght = 0.04");
    refused(&scene, "strenght", &["did you mean `strength`"]);
}

#[test]
fn a_negative_spacing() {
    refused(
        &with("spacing = 0.02", "spacing = -0.02"),
        "spacing",
        &["more than 0 m", "-0.02"],
    );
}

#[test]
fn not_a_number_in_a_parameter() {
    let scene = with("strength = 0.04", "strength = nan");
    refused(
        &scene,
        "strength",
        &["smoother.brezzi-pitkaranta.strength", "finite", "NaN"],
    );
}

#[test]
fn a_unit_that_measures_something_else() {
    refused(&with("1 mPa s", "1 m/s"), "viscosity = ", &["Pa s"]);
}

#[test]
fn overlapping_bodies() {
    let second = "[body.drop]\nphase = \"water\"\nbox = [[0.1, 0.1], [0.3, 0.2]]\n\n[probe.front]";
    let scene = with("[probe.front]", second);
    refused(&scene, "[body.drop]", &["column", "drop", "overlap"]);
}

#[test]
fn a_body_through_a_wall() {
    let scene = with(
        "box = [[0.0, 0.0], [0.2, 0.4]]",
        "box = [[-0.1, 0.0], [0.2, 0.4]]",
    );
    refused(
        &scene,
        "[body.column]",
        &["body.column", "through wall `tank`"],
    );
}

#[test]
fn a_free_end_of_a_wall_within_reach() {
    let open = "polyline = [[0.0, 0.3], [0.0, 0.0], [0.6, 0.0], [0.6, 0.6]]\n";
    let from = "polyline = [[0.0, 0.0], [0.6, 0.0], [0.6, 0.6], [0.0, 0.6]]\nclosed = true\n";
    // Another wall comes first, so that the right one must be pointed at.
    let plate = "[wall.plate]\npolyline = [[0.4, 0.2], [0.5, 0.2]]\nthickness = 0.04\n[wall.tank]";
    let words = [
        "first end of wall `tank` at (0, 0.3) is free",
        "close the wall or extend it",
    ];
    let scene = with(from, open).replace("[wall.tank]", plate);
    refused(&scene, "[wall.tank]", &words);
}

#[test]
fn more_particles_than_memory_are_refused_fast() {
    let start = Instant::now();
    let scene = with("spacing = 0.02", "spacing = 2.8e-7");
    refused(
        &scene,
        "spacing",
        &["1.0e12 particles", "GB", "larger spacing"],
    );
    assert!(
        start.elapsed() < Duration::from_secs(5),
        "it took {:?}",
        start.elapsed()
    );
}

#[test]
fn an_unknown_output_field() {
    let scene = with("\"velocity\", \"pressure\"", "\"velocity\", \"presure\"");
    refused(
        &scene,
        "fields = ",
        &["`presure`", "did you mean `pressure`"],
    );
}

#[test]
fn a_missing_reference_file() {
    let reference = "[reference.front]\nprobe = \"front\"\nfile = \"gone.csv\"\n\n[output]";
    refused(
        &with("[output]", reference),
        "file = ",
        &["reference.front.file", "gone.csv"],
    );
}

#[test]
fn several_mistakes_are_told_at_once() {
    let scene =
        with("spacing = 0.02", "spacing = -1").replace("density = 1000.0", "density = true");
    refused(
        &scene,
        "spacing",
        &["numerics.spacing", "phase.water.density", "2 problems"],
    );
}

#[test]
fn broken_toml_is_shown_where_it_breaks() {
    refused(
        &with("end = 0.4", "end = = 0.4"),
        "end = =",
        &["scene.toml"],
    );
}

#[test]
fn an_unknown_path_of_an_override() {
    let bench = Bench::with(PROGRAM, DAM_BREAK);
    for (set, words) in [
        ("numerics.spcing=1", ["did you mean `spacing`", "--set:1:"]),
        (
            "numerics.spacing",
            ["--set numerics.spacing", "found no `=`"],
        ),
        ("phase.water.density=-1", ["more than 0", "--set:1:"]),
    ] {
        let outcome = bench.call(&format!("run scene.toml --set {set}"));
        assert_eq!(outcome.code, Some(2), "{}", outcome.err);
        says(&outcome, &words);
        nothing_written(&bench);
    }
}

#[test]
fn an_unknown_scene_file() {
    let bench = Bench::with(PROGRAM, DAM_BREAK);
    for (name, words) in [
        ("nosuch.toml", ["`nosuch.toml`", "sph scenes"]),
        (
            "dam-break-koshizuca",
            ["did you mean", "`dam-break-koshizuka`"],
        ),
    ] {
        let outcome = bench.call(&format!("run {name}"));
        assert_eq!(outcome.code, Some(2), "{}", outcome.err);
        says(&outcome, &words);
        nothing_written(&bench);
    }
}

#[test]
fn bad_usage_is_code_2() {
    let bench = Bench::with(PROGRAM, DAM_BREAK);
    for words in [
        "",
        "run",
        "fly",
        "run scene.toml --threads 0",
        "run scene.toml --resume",
    ] {
        let outcome = bench.call(words);
        assert_eq!(outcome.code, Some(2), "sph {words}: {}", outcome.err);
        nothing_written(&bench);
    }
}

/// Ten rows of 0.1 m fill 95 % of a channel 1.05 m high: a void, or a pressure that is 5 % of ρc² too low.
#[test]
fn a_spacing_that_does_not_divide_the_distance_of_walls_is_remarked_upon() {
    let channel = |height: f64| {
        format!(
            "title = \"A channel\"\ndimension = 2\n[run]\nend = 1e-3\n[numerics]\nspacing = 0.1\nperiodic.x = [0.0, 2.0]\n\
             [walls.usaw]\nvertices = false\n\
             [wall.floor]\npolyline = [[0.0, 0.0], [2.0, 0.0]]\n\
             [wall.roof]\npolyline = [[2.0, {height}], [0.0, {height}]]\n\
             [phase.water]\ndensity = 1000.0\nspeed_of_sound = 10.0\n\
             [phase.water.rheology.newtonian]\nviscosity = 1.0\n\
             [body.water]\nphase = \"water\"\nbox = [[0.0, 0.0], [2.0, {height}]]\n"
        )
    };
    let said = |height: f64| {
        let outcome = Bench::with(PROGRAM, &channel(height)).done("check scene.toml");
        outcome.out + &outcome.err
    };
    let odd = said(1.05).split_whitespace().collect::<Vec<_>>().join(" ");
    assert!(
        odd.contains("body `water` fill 95.2 % of its space"),
        "{odd}"
    );
    assert!(!said(1.0).contains("of its space"), "{}", said(1.0));
}
