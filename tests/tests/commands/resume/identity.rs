//! A run goes on with what it began with: the scene, its files, the program.

use sph_io::Checkpoint;
use sph_tests::{PADDLE, bench};

/// The paddle moved by a table, a tank from a drawing, and a reference beside it.
fn scene() -> String {
    let tank = "polyline = [[0.0, 0.0], [0.6, 0.0], [0.6, 0.6], [0.0, 0.6]]\nclosed = true\n";
    let moved = "[wall.paddle.motion]\nvelocity = [-0.2, 0.0]\nstart = 0.05\nstop = 0.3\n";
    assert!(PADDLE.contains(tank) && PADDLE.contains(moved));
    let table = "[wall.paddle.motion]\ntranslate = { along = [-1, 0], file = \"motion.csv\" }\n";
    let reference = "[reference.front]\nprobe = \"front\"\nfile = \"front.csv\"\n";
    PADDLE
        .replace(tank, "file = \"tank.csv\"\n")
        .replace(moved, table)
        + reference
}

const MOTION: &str = "0,0\n0.1,0.01\n0.4,0.05\n";
const TANK: &str = "0,0\n0.6,0\n0.6,0.6\n0,0.6\n0,0\n";
const FRONT: &str = "time,front\n0,0.2\n0.4,0.6\n";

#[test]
fn a_file_that_changed_after_a_kill_is_named_and_refused() {
    let bench = bench!(&scene());
    let files = [
        ("motion.csv", MOTION),
        ("tank.csv", TANK),
        ("front.csv", FRONT),
    ];
    for (name, text) in files {
        bench.write(name, text);
    }
    let run = "run scene.toml --quiet --out r --threads 1";
    bench.start_until(run, "r", 0.1).kill();
    let series = bench.read("r/series.csv");
    let changes = [
        // Ten times as far; one digit of the same length; another reference.
        (
            "motion.csv",
            "0,0\n0.1,0.1\n0.4,0.5\n",
            "wall.paddle.motion.translate[0].file",
        ),
        (
            "tank.csv",
            "0,0\n0.7,0\n0.7,0.6\n0,0.6\n0,0\n",
            "wall.tank.file",
        ),
        (
            "front.csv",
            "time,front\n0,0.2\n0.4,0.7\n",
            "reference.front.file",
        ),
    ];
    for ((name, changed, key), (_, whole)) in changes.into_iter().zip(files) {
        bench.write(name, changed);
        let refused = bench.failed(&format!("{run} --resume"));
        let key = key.replace("[0]", "");
        for told in [
            format!("`{name}`"),
            "--changed".into(),
            "has changed".into(),
        ] {
            refused.says(&told);
        }
        let plain = refused.err.replace("[0]", "");
        assert!(plain.contains(&key), "no `{key}` in {}", refused.err);
        assert_eq!(bench.read("r/series.csv"), series, "the series was touched");
        bench.write(name, whole);
    }
    // Whoever says so goes on all the same; what was not changed goes on without a word.
    bench.write("front.csv", "time,front\n0,0.2\n0.4,0.7\n");
    bench.done(&format!("{run} --resume --changed --set run.end=0.2"));
    bench.write("front.csv", FRONT);
}

#[test]
fn a_file_that_did_not_change_is_no_reason() {
    let bench = bench!(&scene());
    for (name, text) in [
        ("motion.csv", MOTION),
        ("tank.csv", TANK),
        ("front.csv", FRONT),
    ] {
        bench.write(name, text);
    }
    let run = "run scene.toml --quiet --out r --set run.end=0.05";
    bench.done(run);
    // The time of a file does not count, only what is in it.
    bench.write("motion.csv", MOTION);
    bench.done(&format!("{run} --resume"));
}

#[test]
fn another_version_of_the_program_is_named_and_refused() {
    let bench = bench!(PADDLE);
    let run = "run scene.toml --quiet --out r --set run.end=0.02";
    bench.done(run);
    let path = bench.path("r/checkpoint.sph");
    let whole = Checkpoint::load(&path).expect("a checkpoint");
    for (version, told) in [(Some("0.0.7"), "sph 0.0.7"), (None, "an earlier version")] {
        let mut other = whole.clone();
        match version {
            Some(version) => other.meta["version"] = version.into(),
            None => {
                let removed = other.meta.as_object_mut().and_then(|m| m.remove("version"));
                assert!(removed.is_some(), "no version in {}", other.meta);
            }
        }
        other.save(&path).expect("saved");
        bench.failed(&format!("{run} --resume")).says(told);
        bench.done(&format!("{run} --resume --changed"));
    }
}
