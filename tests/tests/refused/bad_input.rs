//! Bad input: the place of the mistake, what was expected, the exit code, and nothing written.

use std::time::{Duration, Instant};

use sph_tests::{Bench, DAM_BREAK, Says, bench, exchanged, line_of, one_line, refusals};

/// The scene is refused with code 2, at the line that contains `line`, with these words, and leaves no file.
fn refused(scene: &str, line: &str, words: &str) {
    let bench = bench!(scene);
    let number = line_of(scene, line);
    for command in ["run", "check"] {
        let refused = bench.refused(&format!("{command} scene.toml"));
        refused.says(&format!("scene.toml:{number}: | {words}"));
        nothing_written(&bench);
    }
    // The same for a program.
    let told = bench.call("check scene.toml --json").json();
    let at = |d: &serde_json::Value| d["line"] == number && d["file"] == "scene.toml";
    let mut all = told.as_array().expect("an array").iter();
    assert!(all.any(at), "{told:#}");
}

fn nothing_written(bench: &Bench) {
    assert_eq!(bench.names(), ["scene.toml"], "something was written");
}

/// Each within five seconds, as many particles as it asks for.
#[test]
fn mistakes_of_a_scene_are_refused_at_their_line_fast() {
    for case in refusals(include_str!("bad_input.refused")) {
        let start = Instant::now();
        refused(&case.of(DAM_BREAK), case.at, &case.said.join(" | "));
        let took = start.elapsed();
        assert!(took < Duration::from_secs(5), "{}: {took:?}", case.at);
    }
}

#[test]
fn several_mistakes_are_told_at_once() {
    let negative = exchanged(DAM_BREAK, "spacing = 0.02", "spacing = -1");
    let scene = negative.replace("density = 1000.0", "density = true");
    refused(
        &scene,
        "spacing",
        "numerics.spacing | phase.water.density | 2 problems",
    );
}

#[test]
fn an_unknown_path_of_an_override() {
    let bench = bench!(DAM_BREAK);
    let no_value = "--set numerics.spacing | found no `=`";
    for (set, words) in [
        ("numerics.spcing=1", "did you mean `spacing` | --set:1:"),
        ("numerics.spacing", no_value),
        ("phase.water.density=-1", "more than 0 | --set:1:"),
    ] {
        let refused = bench.refused(&format!("run scene.toml --set {set}"));
        refused.says(words);
        nothing_written(&bench);
    }
}

#[test]
fn an_unknown_scene_file() {
    let bench = bench!(DAM_BREAK);
    let near = "did you mean | `dam-break-koshizuka`";
    for (name, words) in [
        ("nosuch.toml", "`nosuch.toml` | sph scenes"),
        ("dam-break-koshizuca", near),
    ] {
        bench.refused(&format!("run {name}")).says(words);
        nothing_written(&bench);
    }
}

#[test]
fn bad_usage_is_code_2() {
    let bench = bench!(DAM_BREAK);
    let of_run = ["--threads 0", "--resume"].map(|words| format!("run scene.toml {words}"));
    for words in ["", "run", "fly", &of_run[0], &of_run[1]] {
        bench.refused(words);
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
        let outcome = bench!(&channel(height)).done("check scene.toml");
        outcome.out + &outcome.err
    };
    let odd = one_line(&said(1.05));
    odd.says("body `water` fill 95.2 % of its space");
    assert!(!said(1.0).contains("of its space"), "{}", said(1.0));
}
