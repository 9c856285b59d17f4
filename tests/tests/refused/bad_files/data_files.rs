//! What a second attack found, which went for data files, runs and studies.

use std::fs::File;
use std::process::Stdio;

use sph_tests::{Bench, CHECK_AND_RUN, DAM_BREAK, Says, bench, wait_until};

const REFERENCE: &str = "\n[reference.front]\nprobe = \"front\"\nfile = \"r.csv\"\n";

fn with_reference(keys: &str, table: &str) -> Bench {
    let bench = bench!(&format!("{DAM_BREAK}{REFERENCE}{keys}\n"));
    bench.write("r.csv", table);
    bench
}

#[test]
fn references_that_nothing_can_be_compared_with_are_refused_before_the_run() {
    for (table, told) in [
        (
            "t\n0\n1\n",
            "one column where a time and a value are expected",
        ),
        ("t,u\n", "no rows"),
        ("t,u\n0,1\n0.1,nan\n0.2,1\n", "found NaN in row 2"),
        ("t,u\n0,1\n0.1,1e999\n0.2,1\n", "found inf in row 2"),
        ("t,u\n0.2,1\n0,1\n0.1,1\n", "times must not fall"),
        ("t,u\n0.2,1\n0.2,2\n", "all its times are the same"),
    ] {
        let bench = with_reference("", table);
        for command in ["check scene.toml", "run scene.toml --out r"] {
            let refused = bench.refused(command);
            refused.says(&format!("{told} | scene.toml:"));
        }
        assert!(!bench.path("r").exists());
    }
    let band = "norm = \"band\"\nlower = \"a\"\nupper = \"b\"";
    let bench = with_reference(band, "t,a,b\n0,0,1\n0.1,0,inf\n0.2,0,1\n");
    let outcome = bench.call("check scene.toml");
    outcome.says("found inf in row 2 of `b`");
}

#[test]
fn norms_that_cannot_be_computed_are_refused_before_the_run() {
    let bench = bench!();
    bench.write("r.csv", "t,u\n0,1\n1,1\n");
    let scene = format!("{DAM_BREAK}{REFERENCE}");
    bench.refuses(
        "scene.toml",
        &CHECK_AND_RUN,
        &scene,
        include_str!("norms.refused"),
    );
}

/// The run has been paid for: it keeps its summary and says what is missing.
#[test]
fn a_reference_that_goes_while_the_run_goes_on_costs_the_comparison_alone() {
    let bench = with_reference("", "t,u\n0,0.2\n0.4,0.6\n");
    let run = bench.start("run scene.toml --quiet --out r");
    wait_until("no series", || bench.path("r/series.csv").exists());
    std::fs::remove_file(bench.path("r.csv")).expect("a table to remove");
    run.end().ended(0);
    let summary = bench.read("r/summary.json");
    summary.says("reference `front` was not compared");
}

#[test]
fn a_wall_whose_speed_is_no_number_is_refused() {
    let wall = "\n[wall.block]\nbox = [[0.4, 0.3], [0.46, 0.4]]\nfluid = \"outside\"\n\
                motion.translate = { along = [0.0, 1.0], table = [[0, 0], [1, 1e308], [2, -1e308]] }\n";
    let bench = bench!(&format!("{DAM_BREAK}{wall}"));
    bench.refused("check scene.toml").says("wall.block.motion");
}

#[test]
fn a_refused_write_to_stdout_is_an_error() {
    let bench = bench!(DAM_BREAK);
    for words in ["schema", "check scene.toml --json", "plugins"] {
        let full = File::options().write(true).open("/dev/full");
        let mut command = bench.command(words);
        command.stdout(Stdio::from(full.expect("a device")));
        let output = command.output().expect("an end");
        let err = String::from_utf8_lossy(&output.stderr).into_owned();
        assert_eq!(output.status.code(), Some(1), "{words}: {err}");
        assert!(err.contains("cannot write to stdout"), "{words}: {err}");
    }
}

#[test]
fn a_series_that_is_no_file_is_refused() {
    let bench = bench!(DAM_BREAK);
    std::fs::create_dir(bench.path("r")).expect("a folder");
    bench.write("precious", "kept");
    std::os::unix::fs::symlink("../precious", bench.path("r/series.csv")).expect("a link");
    let failed = bench.failed("run scene.toml --quiet --out r --set run.end=0.02");
    failed.says("series.csv");
    assert_eq!(bench.read("precious"), "kept");
}

#[test]
fn a_table_of_a_study_has_nothing_that_a_terminal_obeys() {
    let bench = bench!(DAM_BREAK);
    bench.write(
        "study.toml",
        "title = \"t\"\nscene = \"scene.toml\"\nerror = \"front\"\n[[vary]]\nname = \"v\"\n\
         entries = [{ name = \"\\u001b[2Jx\\u202e\", set = { run.end = 0.01 } }]\n",
    );
    bench.write("scene.toml", format!("{DAM_BREAK}{REFERENCE}"));
    bench.write("r.csv", "t,u\n0,0.2\n0.4,0.6\n");
    let outcome = bench.call("study study.toml --out s");
    let table = bench.read("s/study.csv");
    assert!(table.contains("[2Jx"), "{table}{}", outcome.err);
    assert!(!table.contains(['\u{1b}', '\u{202e}']), "{table:?}");
}
