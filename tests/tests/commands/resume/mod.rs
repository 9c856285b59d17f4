//! A run that is killed or interrupted and resumed ends like the one that was not.
#![cfg(unix)]

use sph_tests::{
    Bench, DAM_BREAK, END_OF_THE_STEP, PADDLE, Results, SOIL, SUB_STEPS, bench, soil_with,
};

mod failing;
mod identity;
mod lock;
mod mach;
mod soak;

fn uninterrupted(bench: &Bench) -> Results {
    bench.done("run scene.toml --quiet --out whole --threads 2");
    Results::read(&bench.path("whole"))
}

/// Starts a run, kills it at a simulated time, resumes it with some number of threads.
fn killed_and_resumed(bench: &Bench, time: f64, threads: u32) -> Results {
    let out = format!("killed-{time}-{threads}");
    let run = format!("run scene.toml --quiet --out {out}");
    bench
        .start_until(&format!("{run} --threads 2"), &out, time)
        .kill();
    bench.done(&format!("{run} --resume --threads {threads}"));
    Results::read(&bench.path(&out))
}

/// A scene, with a `column` of its checkpoint or series, is killed at simulated times and resumed with numbers of threads.
fn resumes(scene: &str, column: &str, kills: &[(f64, u32)]) {
    let bench = bench!(scene);
    let whole = uninterrupted(&bench);
    let state = &whole.state;
    assert!(state.columns.contains_key(column) || state.series.contains(column));
    for (time, threads) in kills {
        let resumed = killed_and_resumed(&bench, *time, *threads);
        let told = format!("{column}: killed at t = {time} s, {threads} threads");
        whole.assert_same(&resumed, &told);
    }
}

#[test]
fn a_killed_run_resumes_bit_for_bit_from_several_moments_with_any_number_of_threads() {
    let kills = [(0.03, 2), (0.11, 2), (0.15, 1), (0.15, 3), (0.29, 2)];
    resumes(DAM_BREAK, "position", &kills);
}

#[test]
fn pressures_that_are_solved_for_surfaces_outlets_and_displacements_go_on_where_they_were() {
    let asked = DAM_BREAK.replace("fields = [", "fields = [\"displacement\", ");
    resumes(&asked, "displacement", &[(0.11, 1)]);
    let with = |tables: &str| format!("{DAM_BREAK}\n{tables}\n");
    let solved = with("[pressure.implicit]\n[surface.cone-test]");
    resumes(&solved, "pressure", &[(0.11, 1)]);
    resumes(&with("[surface.renormalised]"), "position", &[(0.11, 1)]);
    let outlet = with("[outlet.end]\nbeyond = 0.45");
    resumes(&outlet, "outlet.end.water[kg]", &[(0.11, 1), (0.29, 1)]);
}

#[test]
fn a_run_with_a_moving_wall_resumes_while_it_moves_and_after() {
    resumes(PADDLE, "position", &[(0.15, 2), (0.32, 2)]);
}

#[test]
fn displacements_and_stresses_of_a_soil_go_on_where_they_were() {
    resumes(SOIL, "stress_rotation", &[(0.04, 1)]);
    for force in [END_OF_THE_STEP, SUB_STEPS] {
        resumes(&soil_with(force), "elastic_stress", &[(0.04, 1)]);
    }
}

#[test]
fn a_run_that_is_over_stays_as_it_is() {
    let bench = bench!(DAM_BREAK);
    let whole = uninterrupted(&bench);
    bench.done("run scene.toml --quiet --out whole --threads 1 --resume");
    let again = Results::read(&bench.path("whole"));
    whole.assert_same(&again, "resumed at its end");
}

#[test]
fn ctrl_c_leaves_a_checkpoint_and_says_how_to_go_on() {
    stopped_by("-INT");
}

/// Batch systems end what is out of time so.
#[cfg(unix)]
#[test]
fn sigterm_does_the_same() {
    stopped_by("-TERM");
}

fn stopped_by(signal: &str) {
    let bench = bench!(DAM_BREAK);
    let whole = uninterrupted(&bench);
    let mut run = bench.start_until("run scene.toml --out stopped", "stopped", 0.1);
    run.signal(signal);
    let stopped = run.end().ended(1);
    stopped.says("sph run scene.toml --out stopped --resume");
    assert_eq!(bench.summary("stopped")["status"], "interrupted");
    assert!(bench.reached("stopped") < 0.4, "it went on to the end");

    bench.done("run scene.toml --quiet --out stopped --resume");
    let resumed = Results::read(&bench.path("stopped"));
    whole.assert_same(&resumed, &format!("interrupted by {signal}"));
}

/// One number of a summary.
fn summary_number(bench: &Bench, out: &str, key: &str) -> f64 {
    bench.summary(out)[key].as_f64().unwrap_or(f64::NAN)
}

#[test]
fn a_run_starts_from_the_state_of_another() {
    let bench = bench!(DAM_BREAK);
    bench.done("run scene.toml --quiet --out half --set run.end=0.2");
    bench.done("run scene.toml --quiet --out whole");
    bench.done("run scene.toml --quiet --out rest --from half");
    assert_eq!(summary_number(&bench, "rest", "started_at"), 0.2);
    let steps = |out: &str| summary_number(&bench, out, "steps");
    assert_eq!(steps("half") + steps("rest"), steps("whole"));
    // Lists are built anew, so that sums are those of another order: apart by rounding, which an impact enlarges.
    let energy = |out: &str| summary_number(&bench, out, "kinetic_energy");
    let apart = (energy("rest") / energy("whole") - 1.0).abs();
    assert!(apart < 1e-6, "kinetic energies apart by {apart:.1e}");

    // Other settings go on from the same state; the rest of the first run is resumed as usual.
    bench
        .done("run scene.toml --quiet --out other --from half/checkpoint.sph --set run.safety=0.5");
    assert!(steps("other") > 1.5 * steps("rest"));
}

#[test]
fn a_changed_run_may_begin_to_write_fields_but_not_measure_anew() {
    let bench = bench!(DAM_BREAK);
    let run = "run scene.toml --quiet --out out";
    bench.done(&format!("{run} --set run.end=0.1 --set output.vtk=false"));
    assert!(!bench.path("out/fields.pvd").exists());
    let before = bench.read("out/series.csv");
    let failed = bench.failed(&format!(
        "{run} --resume --changed --set probe.mid.kind=front --set probe.mid.axis=x"
    ));
    failed.says("no column `mid[m]`");
    assert_eq!(bench.read("out/series.csv"), before, "and nothing is lost");

    bench.done(&format!("{run} --resume --changed"));
    let listed = bench.read("out/fields.pvd").matches("<DataSet").count();
    assert!(listed > 0, "no fields after 0.1 s");
    assert_eq!(bench.reached("out"), 0.4);
}

#[test]
fn a_state_that_does_not_fit_is_refused() {
    let bench = bench!(DAM_BREAK);
    bench.done("run scene.toml --quiet --out half --set run.end=0.02");
    let refused = |words: &str, code: i32, why: &str| {
        let outcome = bench.call(&format!("run scene.toml {words}")).ended(code);
        outcome.says(why);
    };
    refused("--out new --from nowhere", 2, "no checkpoint in nowhere");
    refused("--out half --from half", 2, "would be overwritten");
    refused("--out new --from half --resume", 2, "cannot be used with");
    let fewer = "--out new --from half --set numerics.spacing=0.04";
    refused(fewer, 1, "particles, the scene");
}
