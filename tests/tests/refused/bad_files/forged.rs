//! Checkpoints with right checksums that no run can have written.

use std::path::PathBuf;

use serde_json::{Value, json};
use sph_io::Checkpoint;
use sph_tests::{Bench, DAM_BREAK, bench};

/// Bits of a real, as headers have them.
fn bits(x: f64) -> Value {
    x.to_bits().into()
}

const RUN: &str = "run scene.toml --quiet --out r --set run.end=0.02";

/// A run, and where its checkpoint is with what is in it.
fn finished() -> (Bench, PathBuf, Checkpoint) {
    let bench = bench!(DAM_BREAK);
    bench.done(RUN);
    let path = bench.path("r/checkpoint.sph");
    let whole = Checkpoint::load(&path).expect("a checkpoint");
    (bench, path, whole)
}

#[test]
fn clocks_and_counters_that_no_run_has_are_refused() {
    let (bench, path, whole) = finished();
    let series = bench.read("r/series.csv");
    let huge: Value = u64::MAX.into();
    let cases: Vec<(&str, Value, &str)> = vec![
        ("/clock/dt", bits(-1e-4), "its step, -0.0001 s"),
        ("/clock/dt", bits(f64::NAN), "its step, NaN s"),
        ("/clock/dt", bits(1e9), "its step, 1000000000 s"),
        ("/clock/time", bits(-0.01), "before the start"),
        ("/clock/time", bits(7.0), "past the end"),
        ("/clock/time", bits(f64::INFINITY), "not finite"),
        ("/clock/list_time", bits(0.5), "not before its time"),
        (
            "/clock/list_builds",
            huge.clone(),
            "18446744073709551615 times",
        ),
        ("/run/step_scale", bits(f64::NAN), "`step_scale` is NaN"),
        ("/run/step_scale", bits(0.0), "`step_scale` is 0"),
        ("/run/step_scale", bits(-1.0), "`step_scale` is -1"),
        ("/run/step_scale", bits(1e300), "`step_scale` is 1"),
        (
            "/run/steps",
            huge.clone(),
            "`steps` is 18446744073709551615",
        ),
        ("/run/rolled_back", huge.clone(), "`rolled_back`"),
        ("/run/outputs", huge.clone(), "`outputs`"),
        ("/run/rows", huge.clone(), "rows of the series"),
        ("/run/checkpoints", huge.clone(), "checkpoints by then"),
        ("/run/last_row", bits(0.9), "`last_row`"),
        ("/run/started_at", bits(f64::NAN), "`started_at`"),
        ("/run/next_output", bits(0.001), "`next_output`"),
        ("/run/next_output", bits(f64::NAN), "`next_output`"),
        ("/run/limited", json!({ "sound": u64::MAX }), "`limited`"),
        ("/run/bounds", json!({ "sound": -1.0 }), "backwards"),
        ("/run/wall_seconds", json!(-3.0), "backwards"),
        ("/run/series_extrema/0", bits(f64::NAN), "extrema"),
        ("/run/left", json!([[bits(-1.0), 3]]), "has left"),
    ];
    for (place, value, told) in cases {
        let mut forged = whole.clone();
        *forged
            .meta
            .pointer_mut(place)
            .unwrap_or_else(|| panic!("no {place}")) = value.clone();
        forged.save(&path).expect("saved");
        let failed = bench.failed(&format!("{RUN} --resume"));
        failed.says(&format!("checkpoint.sph | {told}"));
        assert_eq!(bench.read("r/series.csv"), series, "{place}");
    }
    whole.save(&path).expect("saved");
    bench.done(&format!("{RUN} --resume"));
}

#[test]
fn particles_without_mass_or_with_no_velocity_are_refused() {
    use sph_io::ColumnData::F64;
    let (bench, path, whole) = finished();
    for (column, value, told) in [
        ("mass", 0.0, "without mass"),
        ("mass", -1.0, "without mass"),
        ("mass", f64::NAN, "without mass"),
        ("velocity", f64::NAN, "velocities that are not finite"),
        ("velocity", f64::INFINITY, "velocities that are not finite"),
    ] {
        let mut forged = whole.clone();
        let found = forged.columns.iter_mut().find(|c| c.name == column);
        match &mut found.expect("the column").data {
            F64(values) => values[5] = value,
            _ => panic!("no reals"),
        }
        forged.save(&path).expect("saved");
        for words in ["--resume", "--resume --changed"] {
            bench.failed(&format!("{RUN} {words}")).says(told);
        }
    }
}

#[test]
fn a_state_past_the_end_is_not_taken_from_another_run_either() {
    let bench = bench!(DAM_BREAK);
    bench.done("run scene.toml --quiet --out r --set run.end=0.05");
    let failed = bench.failed("run scene.toml --out s --from r --set run.end=0.02");
    failed.says("past the end of the scene, 0.02 s");
}
