//! The way of every particle since the start: across periodic borders, and only where somebody asks
//! for it.

use sph_tests::{FinalState, PERIODIC, below, bench};

const ASKED: &str = "--set output.fields=[\"displacement\"]";

/// Positions in the order of identity.
fn placed(state: &FinalState, name: &str) -> Vec<[f64; 2]> {
    let values = state.reals(name);
    let mut found = vec![[0.0; 2]; values.len() / 2];
    for (k, id) in state.columns["identity"].iter().enumerate() {
        found[*id as usize] = [values[2 * k], values[2 * k + 1]];
    }
    found
}

#[test]
fn it_is_the_way_across_periodic_borders_and_costs_nothing_unasked() {
    let bench = bench!(PERIODIC);
    bench.done(&format!(
        "run scene.toml --quiet --out start {ASKED} --set run.end=1e-9"
    ));
    bench.done(&format!("run scene.toml --quiet --out end {ASKED}"));
    let [start, end] = ["start", "end"].map(|out| bench.state(out));
    let way = placed(&end, "displacement");
    let (from, to) = (placed(&start, "position"), placed(&end, "position"));
    let mut around = 0;
    let mut longest = 0.0_f64;
    for ((way, from), to) in way.iter().zip(&from).zip(&to) {
        let mut turns = 0.0;
        for k in 0..2 {
            // What is left of the way is a whole number of periods, of 1 m each.
            let left = from[k] + way[k] - to[k];
            below(left - left.round(), 1e-6, "m off whole periods");
            turns += left.round().abs();
        }
        around += usize::from(turns > 0.0);
        longest = longest.max(way[0].hypot(way[1]));
    }
    assert!(around > 0, "the longest way is {longest} m");
    bench.done("run scene.toml --quiet --out without");
    let without = bench.state("without");
    assert!(!without.columns.contains_key("displacement"));
    assert_eq!(placed(&without, "position"), to, "asking changes nothing");
}
