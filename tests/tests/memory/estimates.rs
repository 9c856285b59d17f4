//! What a scene is told to need is what its run allocates.

use dhat::{HeapStats, Profiler};
use sph_particles::run;
use sph_particles::setup::{Memory, examine};
use sph_run::{Identity, RunOptions, Status};
use sph_tests::shipped;

/// The largest difference, of what is allocated: an estimate is to say whether a run fits, not to account for it.
const OFF: f64 = 0.25;

/// Memory of a scene by `check`, and the most that its run had allocated, bytes.
fn told_and_taken(name: &str, overrides: &[&str]) -> (Memory, f64) {
    let scene = shipped(name, overrides);
    let told = examine(&scene).unwrap_or_else(|e| panic!("{name}: {e}"));
    let memory = told.memory;
    let folder = tempfile::tempdir().expect("a temporary folder");
    let options = RunOptions::new(folder.path(), Identity::of_text(name)).threads(1);
    drop(told);
    let profiler = Profiler::builder()
        .testing()
        .trim_backtraces(Some(1))
        .build();
    let summary = run(&scene, &options, &mut ()).unwrap_or_else(|e| panic!("{name}: {e}"));
    assert_eq!(summary.status, Status::Done);
    let taken = HeapStats::get().max_bytes as f64;
    drop(profiler);
    (memory, taken)
}

#[test]
fn the_memory_told_is_what_a_run_allocates_within_a_quarter() {
    let _alone = super::ALONE.lock();
    // Water between walls; the same in space; and a soil with water, an implicit viscosity and a matrix.
    let mut wrong = Vec::new();
    for (name, spacing, end) in [
        ("dam-break-lobovsky", 0.0025, 0.003),
        ("dam-break-spheric2", 0.04, 0.003),
        ("movable-bed-dambreak-sand", 0.008, 0.002),
    ] {
        let spacing = format!("numerics.spacing={spacing}");
        let end = format!("run.end={end}");
        let (memory, taken) = told_and_taken(name, &[&spacing, &end]);
        let told = memory.total();
        let line = format!("{name}: {told:.3e} bytes told, {taken:.3e} taken, {memory:.0?}");
        println!("{line}");
        if (told / taken - 1.0).abs() > OFF {
            wrong.push(line);
        }
    }
    assert!(wrong.is_empty(), "{wrong:#?}");
}
