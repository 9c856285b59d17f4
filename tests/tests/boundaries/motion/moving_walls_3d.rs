//! Walls that move in space: the same bits for any number of threads, and after a kill.
#![cfg(unix)]

use std::thread::sleep;
use std::time::{Duration, Instant};

use sph_tests::{Bench, FinalState, STIRRER};

const PROGRAM: &str = env!("CARGO_BIN_EXE_sph-under-test");

fn run(bench: &Bench, out: &str, words: &str) -> FinalState {
    bench.done(&format!("run scene.toml --quiet --out {out} {words}"));
    FinalState::read(&bench.path(out))
}

/// Simulated time that `series.csv` has reached; zero before it is there.
fn reached(bench: &Bench, out: &str) -> f64 {
    let series = std::fs::read_to_string(bench.path(out).join("series.csv")).unwrap_or_default();
    let first = |line: &str| line.split(',').next()?.parse::<f64>().ok();
    series.lines().filter_map(first).fold(0.0, f64::max)
}

/// Runs, is killed at a simulated time, and resumed with some number of threads.
fn killed_and_resumed(bench: &Bench, time: f64, threads: u32) -> FinalState {
    let out = format!("killed-{time}");
    let words = format!("run scene.toml --quiet --out {out}");
    let mut child = bench.command(&words).spawn().expect("a run");
    let start = Instant::now();
    let checkpoint = bench.path(&out).join("checkpoint.sph");
    while !(checkpoint.exists() && reached(bench, &out) >= time) {
        assert!(child.try_wait().expect("a child").is_none(), "it has ended");
        assert!(start.elapsed() < Duration::from_secs(60), "no progress");
        sleep(Duration::from_millis(1));
    }
    child.kill().expect("SIGKILL");
    assert_eq!(child.wait().expect("its end").code(), None, "not killed");
    run(bench, &out, &format!("--resume --threads {threads}"))
}

#[test]
fn threads_and_kills_change_no_bit_of_a_flow_with_moving_walls_in_space() {
    let bench = Bench::with(PROGRAM, STIRRER);
    let whole = run(&bench, "one", "--threads 1");
    whole.assert_same(&run(&bench, "two", "--threads 2"), "1 and 2 threads");
    // While both walls move, and after one of them has stopped.
    for (time, threads) in [(0.02, 2), (0.06, 1)] {
        let resumed = killed_and_resumed(&bench, time, threads);
        whole.assert_same(&resumed, &format!("killed at t = {time} s"));
    }
    let column = |k: usize| {
        let rows = whole.series.lines().skip(2);
        let cells = rows.filter_map(move |r| r.split(',').nth(k)?.parse::<f64>().ok());
        cells.fold(0.0, |m: f64, x| m.max(x.abs()))
    };
    // Both walls feel the water.
    let header = whole
        .series
        .lines()
        .find(|l| l.starts_with("time"))
        .expect("a header");
    for name in ["block.x", "blade.x"] {
        let at = header.split(',').position(|c| c.starts_with(name));
        assert!(column(at.expect("a column")) > 1.0, "{name}");
    }
}
