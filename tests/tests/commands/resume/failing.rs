//! A run that cannot go on says who, where, which term and what to do, and leaves a state to go on from.

use serde_json::Value;
use sph_tests::{Bench, DAM_BREAK, Outcome, SOAK, STIRRER, Says, bench, files_with_extension};

/// A run that failed.
struct Failed {
    bench: Bench,
    outcome: Outcome,
    /// The entry `failure` of its summary.
    told: Value,
}

fn failed(scene: &str, set: &str) -> Failed {
    let bench = bench!(scene);
    let outcome = bench.failed(&format!("run scene.toml --out out {set}"));
    let summary = bench.summary("out");
    assert_eq!(summary["status"], "failed");
    let failed = Failed {
        told: summary["failure"].clone(),
        bench,
        outcome,
    };
    failed.leaves_whole_files();
    failed
}

impl Failed {
    fn leaves_whole_files(&self) {
        let out = self.bench.path("out");
        assert!(files_with_extension(&out, "tmp").is_empty(), "half a file");
        for name in ["bad_state.png", "bad_state_near.png"] {
            let png = std::fs::read(out.join(name)).unwrap_or_else(|e| panic!("{name}: {e}"));
            let width = png.get(16..20).and_then(|b| b.try_into().ok());
            assert!(png.starts_with(b"\x89PNG\r\n\x1a\n"), "{name}");
            assert_eq!(width.map(u32::from_be_bytes), Some(1200), "{name}");
            assert!(png.ends_with(b"IEND\xaeB`\x82"), "{name}");
            assert!(self.outcome.err.contains(name), "{}", self.outcome.err);
        }
        let fields = std::fs::read(out.join("bad_state.vtu")).expect("fields");
        assert!(fields.ends_with(b"</VTKFile>\n"));
    }

    /// What both the summary and the terminal must say.
    fn says(&self, quantity: &str, texts: &[&str]) {
        assert_eq!(self.told["cause"]["quantity"], quantity, "{}", self.told);
        let particle = &self.told["particle"];
        let number = format!("number {} of body `", particle["number"]);
        for text in texts.iter().copied().chain([&*number, "what may help"]) {
            self.outcome.says(text);
        }
    }

    /// The first term of a state, and |a| of the terms in order.
    fn terms(&self, state: &str) -> (String, Vec<f64>) {
        let shares = self.told[state].as_array().expect("shares");
        let sizes = shares.iter().map(|s| s["acceleration"].as_f64());
        let first = shares
            .first()
            .map_or("", |s| s["term"].as_str().expect("a name"));
        (
            first.to_string(),
            sizes.map(|s| s.unwrap_or(f64::INFINITY)).collect(),
        )
    }
}

fn descend(sizes: &[f64]) {
    assert!(!sizes.is_empty(), "no sizes");
    assert!(sizes.is_sorted_by(|a, b| a >= b), "{sizes:?}");
}

#[test]
fn particles_that_collide_end_in_a_report_with_the_largest_term() {
    // 100 m/s are three times the speed of sound: allowed by name, so that the density fails it.
    let noise = "--set numerics.velocity_noise=100 --set numerics.supersonic=true";
    let set = format!("{noise} --set run.retries=2 --set numerics.density_bounds=[0.02,1.5]");
    let failed = failed(DAM_BREAK, &set);
    let texts = [
        "2 roll-backs",
        "bound `sound`",
        "phase `water`",
        "nearest neighbour",
    ];
    failed.says("density", &texts);
    assert_eq!(failed.told["retries"], 2);
    let (first, sizes) = failed.terms("before");
    descend(&sizes);
    assert!(sizes.len() == 4 && sizes[0] > 981.0, "{sizes:?}");
    let told = format!("the largest term was `{first}`");
    failed.outcome.says(&told);
    // The state before it is a checkpoint, from which the same ends the same.
    failed
        .bench
        .failed(&format!("run scene.toml --out out --resume {set}"));
    // Mended it goes on, if one says so.
    let mended = format!("run scene.toml --out out --resume {noise}");
    let refused = failed.bench.call(&mended);
    refused.says("--changed");
    failed.bench.done(&format!("{mended} --changed"));
    for name in ["bad_state.vtu", "bad_state.png", "bad_state_near.png"] {
        assert!(!failed.bench.path(&format!("out/{name}")).exists());
    }
}

#[test]
fn an_escaped_particle_is_shown_at_its_last_place() {
    let domain = "--set numerics.domain=[[-0.1,-0.1],[0.35,0.7]] --set run.retries=1";
    let failed = failed(DAM_BREAK, domain);
    failed.says(
        "position",
        &[
            "outside the domain",
            "[outlet.NAME]",
            "body `column`",
            "no term was large",
        ],
    );
    let seen = |when: &str| failed.told["particle"][when]["position"][0].as_f64();
    let (before, after) = (
        seen("before").expect("a place"),
        seen("after").expect("a place"),
    );
    assert!(before <= 0.35 && after > 0.35, "from {before} to {after}");
    descend(&failed.terms("before").1);
    assert!(failed.told["after"].as_array().is_some_and(Vec::is_empty));
    let wider = "--set numerics.domain=[[-0.1,-0.1],[0.8,0.7]]";
    failed.bench.done(&format!(
        "run scene.toml --out out --resume --changed {wider}"
    ));
}

#[test]
fn a_density_out_of_bounds_is_told_without_a_state_to_go_back_to() {
    let bounds = "--set numerics.density_bounds=[0.9999,1.0001] --set run.retries=0";
    let failed = failed(DAM_BREAK, bounds);
    failed.says(
        "density",
        &["run.retries = 5", "density_bounds", "at the bad state"],
    );
    descend(&failed.terms("after").1);
    assert!(failed.told["particle"]["before"].is_null());
}

#[test]
fn a_solver_that_gives_up_is_told_with_its_remedy() {
    let set = "--set numerics.spacing=0.02 --set run.retries=1 \
               --set linear-solver.conjugate-gradient.iterations=1";
    let failed = failed(SOAK, set);
    failed.says(
        "implicit viscosity",
        &["largest acceleration", "linear-solver.cholesky"],
    );
    assert_eq!(failed.told["particle"]["named"], false);
    descend(&failed.terms("before").1);
}

#[test]
fn three_dimensions_are_drawn_too() {
    let bounds = "--set numerics.density_bounds=[0.995,1.005] --set run.retries=1";
    let failed = failed(STIRRER, bounds);
    failed.says("density", &["body `column`"]);
    let place = failed.told["particle"]["after"]["position"].as_array();
    assert_eq!(place.map(Vec::len), Some(3));
}

/// An obstacle on the floor, inside out and with open feet, in the way of a column of water.
const LEAKING: &str = include_str!("leaking.toml");

#[test]
fn a_step_that_fails_beside_an_open_wall_is_not_tried_again() {
    let failed = failed(LEAKING, "--threads 1");
    let told = &failed.outcome.err;
    failed.says(
        "density",
        &[
            "mend the wall beside the particle",
            "wall.obstacle",
            "not tried again",
        ],
    );
    told.says("note: scene.toml:13: wall.obstacle: its first end");
    assert!(!told.contains("going back"), "{told}");
    assert_eq!(failed.told["retries"], 0);
}
