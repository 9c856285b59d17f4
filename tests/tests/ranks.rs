//! A scene that is divided between ranks gives the bits of one process.

use std::path::Path;

use sph_tests::{Bench, DAM_BREAK, FinalState, PADDLE, SOIL};

const PROGRAM: &str = env!("CARGO_BIN_EXE_sph-under-test");

fn series(folder: &Path) -> String {
    std::fs::read_to_string(folder.join("series.csv")).expect("a series")
}

fn same_on_all_ranks(scene: &str, set: &str) {
    let bench = Bench::with(PROGRAM, scene);
    let run = |out: &str, ranks: u32| {
        bench.done(&format!(
            "run scene.toml --quiet --out {out} --threads 1 --ranks {ranks} {set}"
        ));
        (FinalState::of(&bench.path(out)), series(&bench.path(out)))
    };
    let (one, row) = run("r1", 1);
    for ranks in [2, 3, 4] {
        let (state, rows) = run(&format!("r{ranks}"), ranks);
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
