//! Pressure from the end of the step.

use sph_core::Vect;
use sph_pressure as _;
use sph_tests::Bench;

use crate::order::{after, vortices};

const PROGRAM: &str = env!("CARGO_BIN_EXE_sph-under-test");

/// Root of the mean square over that of `b`.
fn apart(a: &[Vect<2>], b: &[Vect<2>]) -> f64 {
    let squares = a.iter().zip(b).map(|(a, b)| (a - b).norm_squared());
    let whole = b.iter().map(|b| b.norm_squared());
    (squares.sum::<f64>() / whole.sum::<f64>()).sqrt()
}

#[test]
fn with_small_steps_it_is_the_explicit_scheme_to_first_order() {
    let ahead = "[pressure.implicit]\ntolerance = 1e-12";
    let difference = |steps| {
        let solved = after(&vortices("symplectic-euler", ahead), steps);
        apart(&solved, &after(&vortices("symplectic-euler", ""), steps))
    };
    let runs = [160, 320, 640].map(difference);
    let order = (runs[1] / runs[2]).log2();
    assert!(
        (order - 1.0).abs() < 0.15,
        "order {order:.3} of the difference, {runs:?}"
    );
}

#[test]
fn a_scene_that_asks_for_no_step_or_no_solve_is_refused_with_its_line() {
    let scene = format!(
        "{}\n[pressure.implicit]\ncourant = 0.0\n",
        sph_tests::DAM_BREAK
    );
    let bench = Bench::with(PROGRAM, &scene);
    let outcome = bench.call("run scene.toml --quiet --out r");
    assert_eq!(outcome.code, Some(2), "{}", outcome.err);
    assert!(outcome.err.contains("courant = 0.0"), "{}", outcome.err);
    assert!(!bench.path("r").exists());
}

#[test]
fn a_surface_that_the_scene_does_not_name_is_refused() {
    let scene = format!("{}\n[pressure.implicit]\n", sph_tests::DAM_BREAK);
    let bench = Bench::with(PROGRAM, &scene);
    let outcome = bench.call("run scene.toml --quiet --out r");
    assert_ne!(outcome.code, Some(0));
    assert!(
        outcome.err.contains("[surface.cone-test]"),
        "{}",
        outcome.err
    );
}
