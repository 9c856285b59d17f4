//! Output times are reached with every formulation, whatever the last digit of the clock.

use sph_tests::{PERIODIC, bench};

/// Drifts in two halves ended a rounding short of these times, and the step that was left was too
/// short for its halves to move the clock.
#[test]
fn a_drift_in_halves_does_not_stop_short_of_an_output() {
    let bench = bench!(PERIODIC);
    for every in ["0.0472", "0.03", "0.07", "0.013"] {
        let words = format!(
            "run scene.toml --quiet --out {every} --set run.end=0.4 --set run.max_steps=400 \
             --set output.every={every} --set formulation={{\"colagrossi-landrini\"={{}}}}"
        );
        bench.done(&words);
        let series = bench.state(every).series;
        let last = series.lines().last().expect("a row").to_string();
        assert!(last.starts_with("0.4,"), "every {every}: {last}");
    }
}
