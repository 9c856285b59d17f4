//! A model that the driver does not know gets outputs, series, checkpoints, resume and summary.

#[path = "../examples/heat_rod.rs"]
mod heat_rod;

use std::path::Path;

use heat_rod::cool;
use sph_run::{CHECKPOINT, Command, Observer, Progress, SERIES, SUMMARY, Start, Status};

/// Stops a run after a number of steps.
struct Until(u64);

impl Observer for Until {
    fn step(&mut self, progress: &Progress) -> Command {
        match progress.step < self.0 {
            true => Command::Continue,
            false => Command::Stop,
        }
    }
    fn message(&mut self, _: &str) {}
}

fn read(folder: &Path, file: &str) -> Vec<u8> {
    std::fs::read(folder.join(file)).unwrap_or_else(|e| panic!("{file}: {e}"))
}

#[test]
fn a_run_writes_what_is_due_and_goes_on_from_its_checkpoint_bit_for_bit() {
    let [whole, halves] = [(), ()].map(|()| tempfile::tempdir().expect("a folder"));
    let (whole, halves) = (whole.path(), halves.path());
    let done = cool(whole, Start::Afresh, 0.4, &mut ()).expect("a run");
    // Second differences and Euler's steps of 0.4 h²/α: |1/12 − 0.4/2| (πh)² · π²αt exp(−π²αt) with h = 1/50.
    assert!(
        done.status == Status::Done && done.error < 1.7e-4,
        "{done:?}"
    );
    let stopped = cool(halves, Start::Afresh, 0.4, &mut Until(333)).expect("a run");
    assert_eq!((stopped.status, stopped.steps), (Status::Interrupted, 333));
    let resumed = cool(halves, Start::Resumed, 0.4, &mut ()).expect("a run");
    assert_eq!(resumed.steps, done.steps);
    for file in [
        SERIES,
        SUMMARY,
        "fields.pvd",
        "fields/rod_000010.vtu",
        "pictures/temperature_0010.png",
    ] {
        assert!(read(whole, file) == read(halves, file), "{file}");
    }
    let rows = String::from_utf8(read(whole, SERIES)).expect("a text");
    assert_eq!(rows.lines().count(), 1 + 101, "{rows}");
    // The next run does not resume what it overwrites.
    let mut told = Notes::default();
    cool(whole, Start::Afresh, 0.4, &mut told).expect("a run");
    assert!(
        whole.join(CHECKPOINT).exists() && told.0.contains("is overwritten"),
        "{}",
        told.0
    );
}

/// Explicit steps beyond one half are unstable: rounding grows by 4 · 0.6 − 1 a step, to the temperature itself.
#[test]
fn a_step_that_fails_leaves_a_summary_and_what_was_due_before() {
    let folder = tempfile::tempdir().expect("a folder");
    let error = cool(folder.path(), Start::Afresh, 0.6, &mut ()).expect_err("a failure");
    let told = error.to_string();
    assert!(told.contains("warmer than at the start"), "{told}");
    let summary = String::from_utf8(read(folder.path(), SUMMARY)).expect("a text");
    let failed = summary.contains("\"failed\"") && !summary.contains("\"done\"");
    assert!(failed, "{summary}");
    assert!(read(folder.path(), "pictures/temperature_0001.png").starts_with(b"\x89PNG"));
    let last = folder.path().join("fields/rod_000010.vtu");
    assert!(!last.exists(), "the end was not reached");
}

#[derive(Default)]
struct Notes(String);

impl Observer for Notes {
    fn step(&mut self, _: &Progress) -> Command {
        Command::Continue
    }
    fn message(&mut self, text: &str) {
        self.0.push_str(text);
    }
}
