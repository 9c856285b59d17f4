//! A scene that is divided between ranks gives the bits of one process.

use std::path::Path;

use sph_tests::{Bench, DAM_BREAK, FinalState, PADDLE, SOIL};

const PROGRAM: &str = env!("CARGO_BIN_EXE_sph-under-test");

fn series(folder: &Path) -> String {
    std::fs::read_to_string(folder.join("series.csv")).expect("a series")
}

/// A run's last state and its series, after a run with these arguments.
fn ran(bench: &Bench, out: &str, arguments: &str) -> (FinalState, String) {
    bench.done(&format!(
        "run scene.toml --quiet --out {out} --threads 1 {arguments}"
    ));
    let folder = bench.path(out);
    (FinalState::of(&folder), series(&folder))
}

fn same_on_all_ranks(scene: &str, set: &str) {
    let bench = Bench::with(PROGRAM, scene);
    let (one, row) = ran(&bench, "r1", set);
    for ranks in [2, 3, 4] {
        let (state, rows) = ran(
            &bench,
            &format!("r{ranks}"),
            &format!("--ranks {ranks} {set}"),
        );
        one.assert_same(&state, &format!("1 and {ranks} ranks"));
        assert_eq!(row, rows, "series of 1 and {ranks} ranks");
    }
}

#[test]
fn a_dam_break_gives_the_same_bits() {
    same_on_all_ranks(DAM_BREAK, "");
}

#[test]
fn a_moving_wall_gives_the_same_bits() {
    same_on_all_ranks(PADDLE, "");
}

#[test]
fn a_soil_gives_the_same_bits() {
    same_on_all_ranks(SOIL, "--set run.end=0.06");
}

#[test]
fn a_run_goes_on_with_another_number_of_ranks() {
    let bench = Bench::with(PROGRAM, DAM_BREAK);
    let (whole, row) = ran(&bench, "whole", "");
    let out = "run scene.toml --quiet --out parts --threads 1";
    let stopped = bench.call(&format!("{out} --ranks 4 --set run.max_steps=40"));
    assert_eq!(stopped.code, Some(1), "{stopped:?}");
    bench.done(&format!("{out} --ranks 2 --resume --changed"));
    let folder = bench.path("parts");
    whole.assert_same(&FinalState::of(&folder), "4 ranks, then 2");
    assert_eq!(row, series(&folder));
}

#[test]
fn what_cannot_be_divided_is_refused_before_anything_is_written() {
    let leaves = format!("{DAM_BREAK}\n[outlet.end]\nbeyond = 0.45\n");
    let kept = format!("{DAM_BREAK}\n[integrator.verlet]\n");
    for (scene, ranks, why) in [
        (
            leaves.as_str(),
            2,
            "cannot run on several ranks: particles leave",
        ),
        (kept.as_str(), 2, "goes back to a state within a step"),
        (DAM_BREAK, 256, "some would own nothing"),
    ] {
        let bench = Bench::with(PROGRAM, scene);
        let more = if ranks > 2 {
            "--set numerics.spacing=0.1"
        } else {
            ""
        };
        let refused = bench.call(&format!("run scene.toml --out r --ranks {ranks} {more}"));
        let told = &refused.err;
        assert_eq!(refused.code, Some(2), "{told}");
        assert!(told.contains(why), "{told}");
        assert!(!bench.path("r").exists(), "{why}");
    }
}

#[cfg(not(feature = "mpi"))]
#[test]
fn mpirun_is_left_out() {
    println!("skipped: built without the feature `mpi` (crates/sph-mpi/README.md)");
}

/// Ranks that are processes; ends with the bits of one process.
#[cfg(feature = "mpi")]
#[test]
fn mpirun_gives_the_same_bits() {
    let bench = Bench::with(PROGRAM, DAM_BREAK);
    let (one, row) = ran(&bench, "r1", "");
    for ranks in [1, 2, 4] {
        let out = format!("m{ranks}");
        let done = mpirun(&bench, ranks, &out).output().expect("mpirun");
        assert!(done.status.success(), "{done:?}");
        one.assert_same(
            &FinalState::of(&bench.path(&out)),
            &format!("{ranks} processes"),
        );
        assert_eq!(
            row,
            series(&bench.path(&out)),
            "series of {ranks} processes"
        );
    }
}

/// One of four ranks is killed in mid-run: the job ends, the last checkpoint is whole, and two ranks go on to the same bits.
#[cfg(feature = "mpi")]
#[test]
fn a_killed_rank_ends_the_job_and_others_go_on_from_the_checkpoint() {
    use std::time::{Duration, Instant};
    let bench = Bench::with(PROGRAM, DAM_BREAK);
    let (whole, row) = ran(&bench, "whole", "");
    let mut job = mpirun(&bench, 4, "killed").spawn().expect("mpirun");
    let checkpoint = bench.path("killed").join("checkpoint.sph");
    let start = Instant::now();
    while !checkpoint.exists() && start.elapsed() < Duration::from_secs(60) {
        std::thread::sleep(Duration::from_millis(5));
    }
    kill_a_child(job.id());
    let killed = Instant::now();
    let ended = job.wait().expect("an end");
    assert!(
        killed.elapsed() < Duration::from_secs(60),
        "{:?}",
        killed.elapsed()
    );
    if ended.success() {
        println!("the run was over before it was killed");
    }
    bench.done("run scene.toml --quiet --out killed --threads 1 --ranks 2 --resume");
    whole.assert_same(&FinalState::of(&bench.path("killed")), "killed and resumed");
    assert_eq!(row, series(&bench.path("killed")));
}

/// Kills the youngest process that mpirun has started.
#[cfg(feature = "mpi")]
fn kill_a_child(parent: u32) {
    let children = std::process::Command::new("pgrep")
        .args(["-P", &parent.to_string()])
        .output()
        .expect("pgrep");
    let children = String::from_utf8_lossy(&children.stdout);
    if let Some(child) = children.lines().last() {
        let _ = std::process::Command::new("kill")
            .args(["-9", child])
            .status();
    }
}

#[cfg(feature = "mpi")]
fn mpirun(bench: &Bench, ranks: usize, out: &str) -> std::process::Command {
    let mut job = std::process::Command::new("mpirun");
    // More ranks than cores, and in containers everybody is root.
    job.args([
        "--oversubscribe",
        "--allow-run-as-root",
        "-n",
        &ranks.to_string(),
        PROGRAM,
    ]);
    job.args([
        "run",
        "scene.toml",
        "--quiet",
        "--threads",
        "1",
        "--out",
        out,
    ]);
    job.current_dir(bench.folder());
    job
}
