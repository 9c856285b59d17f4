//! Walls that move in space: the same bits for any number of threads, and after a kill.
#![cfg(unix)]

use sph_tests::{Bench, FinalState, STIRRER, bench};

fn run(bench: &Bench, out: &str, words: &str) -> FinalState {
    bench.done(&format!("run scene.toml --quiet --out {out} {words}"));
    bench.state(out)
}

/// Runs, is killed at a simulated time, and resumed with some number of threads.
fn killed_and_resumed(bench: &Bench, time: f64, threads: u32) -> FinalState {
    let out = format!("killed-{time}");
    let words = format!("run scene.toml --quiet --out {out}");
    bench.start_until(&words, &out, time).kill();
    run(bench, &out, &format!("--resume --threads {threads}"))
}

#[test]
fn threads_and_kills_change_no_bit_of_a_flow_with_moving_walls_in_space() {
    let bench = bench!(STIRRER);
    let whole = run(&bench, "one", "--threads 1");
    whole.assert_same(&run(&bench, "two", "--threads 2"), "1 and 2 threads");
    // While both walls move, and after one of them has stopped.
    for (time, threads) in [(0.02, 2), (0.06, 1)] {
        let resumed = killed_and_resumed(&bench, time, threads);
        whole.assert_same(&resumed, &format!("killed at t = {time} s"));
    }
    // Both walls feel the water.
    for name in ["block.x", "blade.x"] {
        assert!(bench.series("one").largest_size(name) > 1.0, "{name}");
    }
}
