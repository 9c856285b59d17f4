//! Scenes that name no numerics: their errors over those of the scenes as shipped.

use sph_tests::shipped;

use crate::shipped::{by_default, finished};

/// Largest error over that of the scene as shipped.
const RATIO: f64 = 1.3;

/// Compares the errors of a shipped scene with those of the same scene without its numerics.
fn no_worse(name: &str, overrides: &[&str], references: &[&str]) {
    let (shipped, without) = (finished(name, overrides), by_default(name, overrides));
    for reference in references {
        let bound = RATIO * shipped.error(reference, f64::MAX, 0.0);
        without.error(reference, bound, 0.0);
    }
}

#[test]
fn a_cavity_that_names_no_numerics_is_no_worse() {
    let sets = [
        "numerics.spacing=0.04 run.end=10 reference.u.window=[8, 10] reference.v.window=[8, 10] \
         reference.ghia.window=[8, 10]",
    ];
    no_worse("cavity", &sets, &["u", "v", "ghia"]);
}

#[test]
fn a_channel_and_vortices_that_name_no_numerics_are_no_worse() {
    no_worse("poiseuille-2d", &["numerics.spacing=0.03125"], &["profile"]);
    no_worse(
        "taylor-green-2d",
        &["numerics.spacing=0.025"],
        &["velocity-l1", "velocity-linf"],
    );
}

#[test]
fn tanks_and_a_dam_break_that_name_no_numerics_are_no_worse() {
    no_worse(
        "hydrostatic-tank",
        &["run.end=2"],
        &["pressure-l2", "pressure", "rest"],
    );
    no_worse("hydrostatic-wedge", &["run.end=2"], &["pressure"]);
    let sets = ["numerics.spacing=0.012", "run.end=0.97"];
    no_worse("dam-break-lobovsky", &sets, &["P2-inviscid", "P2", "P4"]);
}

/// Hills leave space between walls and rows; the other walls are whole rows apart, or the body has no walls to fill.
#[test]
fn fluids_that_leave_space_between_walls_are_relaxed() {
    let relaxed = |name: &str| {
        let scene = shipped(name, &[]);
        scene.suited.iter().any(|(key, _)| *key == "numerics.relax")
    };
    assert!(relaxed("periodic-hill"));
    for name in ["backward-step", "moving-square", "cavity", "poiseuille-2d"] {
        assert!(!relaxed(name), "{name}");
    }
}
