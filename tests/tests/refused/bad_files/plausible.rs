//! Numbers that nature does not have are remarked upon at their line, and those with which no run can be right
//! are refused there.

use sph_tests::{Bench, DAM_BREAK, SOIL};

use crate::bad_files::PROGRAM;

/// A scene with whole lines of it replaced, and the number of the last line of the new ones.
fn with(scene: &str, from: &str, to: &str) -> (String, usize) {
    assert!(scene.contains(from), "the scene lost `{from}`");
    let scene = scene.replacen(from, to, 1);
    let last = to.lines().last().expect("a line");
    let line = scene.lines().position(|l| l == last);
    (scene.clone(), 1 + line.expect("the line is there"))
}

#[test]
fn settings_that_no_run_survives_are_refused_at_their_line() {
    let bench = Bench::new(PROGRAM);
    let cases = [
        (
            DAM_BREAK,
            "density = 1000.0",
            "density = 1e308",
            "1e-50 to 1e50 kg/m³",
        ),
        (
            DAM_BREAK,
            "density = 1000.0",
            "density = 1e-308",
            "1e-50 to 1e50 kg/m³",
        ),
        (
            DAM_BREAK,
            "end = 0.4",
            "end = 0.4\nsafety = 1e-300",
            "1e-9 to 1",
        ),
        (
            DAM_BREAK,
            "spacing = 0.02",
            "spacing = 0.02\nsmoothing_ratio = 0.1",
            "0.472 to 20",
        ),
        // The support of this kernel is 2 h.
        (
            DAM_BREAK,
            "spacing = 0.02",
            "spacing = 0.02\nsmoothing_ratio = 0.6",
            "at least 1.414",
        ),
        (
            DAM_BREAK,
            "gravity = [0.0, -9.81]",
            "gravity = [0.0, -1e60]",
            "at most 1e50 m/s²",
        ),
        (
            SOIL,
            "young_modulus = \"0.8 MPa\"",
            "young_modulus = 1e200",
            "1e-50 to 1e50 Pa",
        ),
    ];
    for (scene, from, to, range) in cases {
        let (scene, line) = with(scene, from, to);
        bench.write("scene.toml", &scene);
        for command in ["check", "run"] {
            let outcome = bench.call(&format!("{command} scene.toml"));
            assert_eq!(outcome.code, Some(2), "{to}: {}", outcome.err);
            for word in [&format!("scene.toml:{line}:"), range, "no run can be right"] {
                assert!(
                    outcome.err.contains(word),
                    "{to}: no `{word}` in\n{}",
                    outcome.err
                );
            }
        }
    }
}

#[test]
fn implausible_values_are_remarked_on_at_their_line() {
    let bench = Bench::new(PROGRAM);
    let gauge = "[gauge.g]\nkind = \"level\"\nat = [1e30]\n[output]";
    let cases = [
        (
            DAM_BREAK,
            "density = 1000.0",
            "density = 1e12",
            1,
            "white dwarfs",
        ),
        (
            DAM_BREAK,
            "gravity = [0.0, -9.81]",
            "gravity = [0.0, -1e9]",
            1,
            "centrifuges",
        ),
        (DAM_BREAK, "[output]", gauge, 3, "circumference"),
        (
            SOIL,
            "young_modulus = \"0.8 MPa\"",
            "young_modulus = \"1e4 GPa\"",
            1,
            "diamond",
        ),
    ];
    for (scene, from, to, which, source) in cases {
        let (scene, last) = with(scene, from, to);
        let line = last + which - to.lines().count();
        bench.write("scene.toml", &scene);
        let outcome = bench.call("check scene.toml");
        assert_eq!(outcome.code, Some(0), "{to}: {}", outcome.err);
        let place = format!("scene.toml:{line}:");
        // A line of the remarks may be broken.
        let told = outcome.out.split_whitespace().collect::<Vec<_>>().join(" ");
        for word in [&place, source, "is it meant?"] {
            assert!(told.contains(word), "{to}: no `{word}` in\n{told}");
        }
    }
    bench.write("scene.toml", DAM_BREAK);
    let plain = bench.call("check scene.toml");
    assert!(!plain.out.contains("is it meant?"), "{}", plain.out);
    let set = "run scene.toml --out r --set phase.water.density=1e12 --set run.end=0.01";
    let outcome = bench.call(set);
    assert_eq!(outcome.code, Some(0), "{}", outcome.err);
    assert!(outcome.err.contains("note: --set:1:"), "{}", outcome.err);
    assert!(bench.read("r/summary.json").contains("white dwarfs"));
}

#[test]
fn time_that_would_stand_still_is_refused() {
    let bench = Bench::with(PROGRAM, DAM_BREAK);
    // A step of 1e-4 s is below the distance of doubles at 1e15 s.
    let set = "--set run.end=1e15 --set output.every=1e14 --set output.series_every=1e14 \
               --set run.checkpoint_every=1e14";
    let outcome = bench.call(&format!("check scene.toml {set}"));
    assert_eq!(outcome.code, Some(2), "{}", outcome.err);
    assert!(
        outcome.err.contains("the time would not advance"),
        "{}",
        outcome.err
    );
}
