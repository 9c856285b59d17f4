//! Numbers that nature does not have are remarked upon at their line, and those with which no run can be right
//! are refused there.

use sph_tests::{CHECK_AND_RUN, DAM_BREAK, SOIL, bench};

#[test]
fn settings_that_no_run_survives_are_refused_at_their_line() {
    for (scene, changes) in [
        (DAM_BREAK, include_str!("impossible.refused")),
        (SOIL, include_str!("impossible_soil.refused")),
    ] {
        bench!().refuses("scene.toml", &CHECK_AND_RUN, scene, changes);
    }
}

#[test]
fn implausible_values_are_remarked_on_at_their_line() {
    let bench = bench!();
    bench.remarks(DAM_BREAK, include_str!("implausible.remarked"));
    bench.remarks(SOIL, include_str!("implausible_soil.remarked"));
    bench.write("scene.toml", DAM_BREAK);
    let plain = bench.call("check scene.toml");
    assert!(!plain.out.contains("is it meant?"), "{}", plain.out);
    let set = "run scene.toml --out r --set phase.water.density=1e12 --set run.end=0.01";
    bench.done(set).says("note: --set:1:");
    assert!(bench.read("r/summary.json").contains("white dwarfs"));
}

#[test]
fn time_that_would_stand_still_is_refused() {
    let bench = bench!(DAM_BREAK);
    // A step of 1e-4 s is below the distance of doubles at 1e15 s.
    let set = "--set run.end=1e15 --set output.every=1e14 --set output.series_every=1e14 \
               --set run.checkpoint_every=1e14";
    let refused = bench.refused(&format!("check scene.toml {set}"));
    refused.says("the time would not advance");
}
