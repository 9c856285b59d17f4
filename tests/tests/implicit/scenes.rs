//! Whole runs: bits, and the shipped scenes at test sizes.

use std::path::Path;

use sph_scene::{Override, load};
use sph_solver::{RunOptions, Summary, run};
use sph_tests::{Bench, DAM_BREAK, FinalState};

const PROGRAM: &str = env!("CARGO_BIN_EXE_sph-under-test");

fn finished(name: &str, overrides: &[&str]) -> Summary {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("../scenes/{name}.toml"));
    let overrides: Vec<_> = overrides
        .iter()
        .map(|o| Override::parse(o).unwrap())
        .collect();
    let loaded = load(&path, &overrides).unwrap_or_else(|e| panic!("{e}"));
    let folder = tempfile::tempdir().expect("a temporary folder");
    let options = RunOptions {
        out: folder.path().to_path_buf(),
        resume: false,
        threads: Some(2),
        identity: name.to_string(),
    };
    run(&loaded.scene, &options, &mut ()).unwrap_or_else(|e| panic!("{name}: {e}"))
}

fn error(summary: &Summary, name: &str) -> f64 {
    summary.errors[name].value.expect("something was compared")
}

#[test]
fn one_two_and_four_threads_give_the_same_bits_with_every_solver() {
    for solver in ["cholesky", "conjugate-gradient", "automatic"] {
        let scene =
            format!("{DAM_BREAK}\n[implicit-viscosity.backward-euler]\n[linear-solver.{solver}]\n");
        let bench = Bench::with(PROGRAM, &scene);
        let state = |threads: u32| {
            bench.done(&format!(
                "run scene.toml --quiet --out r{threads} --threads {threads} --set \
                 phase.water.rheology.newtonian.viscosity=50"
            ));
            FinalState::of(&bench.path(&format!("r{threads}")))
        };
        let one = state(1);
        for threads in [2, 4] {
            one.assert_same(
                &state(threads),
                &format!("{solver}: 1 and {threads} threads"),
            );
        }
    }
}

/// Steps 16 500 times the explicit bound of 4.9e-6 s.
#[test]
fn creep_is_stable_far_beyond_the_explicit_bound_and_within_half_a_per_cent() {
    let summary = finished("poiseuille-creep", &[]);
    let found = error(&summary, "profile");
    assert!(found < 0.005, "profile {found}, measured 0.00069");
    let mean_step = summary.simulated_seconds / summary.steps as f64;
    assert!(mean_step > 1e4 * 4.88e-6, "mean step {mean_step}");
    assert!(!summary.dt_limiters.contains_key("viscosity"));
}

#[test]
fn a_viscosity_jump_of_a_million_passes_the_stress_on_within_1_per_cent() {
    let summary = finished("viscosity-jump", &[]);
    for name in ["stress-above", "stress-below"] {
        let found = error(&summary, name);
        assert!(found < 0.01, "{name}: {found}");
    }
}

#[test]
fn explicit_and_implicit_errors_of_the_layered_channel_agree_within_2_per_cent() {
    let size = [
        "numerics.spacing=0.04",
        "numerics.periodic.x=[0,0.48]",
        "wall.bottom.polyline=[[0,-0.5],[0.48,-0.5]]",
        "wall.top.polyline=[[0.48,0.5],[0,0.5]]",
        "body.heavy.box=[[0,-0.5],[0.48,0.5]]",
        "body.light.box=[[0,-0.5],[0.48,0.5]]",
        "run.end=1",
        "reference.profile.window=[0.5,1]",
    ];
    let name = "bifluid-poiseuille-re0p125-implicit";
    let implicit = finished(name, &size);
    let explicitly = ["implicit-viscosity={}", "linear-solver={}"];
    let explicit = finished(name, &[&size[..], &explicitly[..]].concat());
    let (i, e) = (error(&implicit, "profile"), error(&explicit, "profile"));
    assert!((i / e - 1.0).abs() < 0.02, "implicit {i}, explicit {e}");
    assert!(implicit.steps * 4 < explicit.steps);
}
