//! What an implicit scene must not ask for.

use sph_tests::{Bench, DAM_BREAK};

const PROGRAM: &str = env!("CARGO_BIN_EXE_sph-under-test");

fn refused(tables: &str, set: &str) -> String {
    let bench = Bench::with(PROGRAM, &format!("{DAM_BREAK}\n{tables}\n"));
    let outcome = bench.call(&format!("check scene.toml {set}"));
    assert_eq!(outcome.code, Some(2), "{}", outcome.err);
    outcome.err
}

#[test]
fn no_viscosity_at_all_is_refused_at_its_table() {
    let said = refused(
        "[implicit-viscosity.backward-euler]",
        "--set phase.water.rheology.newtonian.viscosity=0",
    );
    assert!(
        said.contains("nothing to solve for") && said.contains("implicit-viscosity"),
        "{said}"
    );
}

#[test]
fn a_negative_viscosity_is_refused() {
    let said = refused(
        "[implicit-viscosity.backward-euler]",
        "--set phase.water.rheology.newtonian.viscosity=-1",
    );
    assert!(said.contains("viscosity"), "{said}");
}

#[test]
fn a_solver_without_anything_to_solve_is_refused() {
    let said = refused("[linear-solver.cholesky]", "");
    assert!(said.contains("linear-solver.cholesky"), "{said}");
}

#[test]
fn a_misspelt_solver_gets_the_nearest_name() {
    let said = refused(
        "[implicit-viscosity.backward-euler]\n[linear-solver.cholesski]",
        "",
    );
    assert!(said.contains("cholesky"), "{said}");
}

/// With tries left the step is repeated with half of its length, without any the run says why it stops.
#[test]
fn a_solver_that_gives_up_stops_the_run_with_its_reason() {
    let tables = "[implicit-viscosity.backward-euler]\n[linear-solver.conjugate-gradient]\n\
         iterations = 1\ntolerance = 1e-14";
    let bench = Bench::with(PROGRAM, &format!("{DAM_BREAK}\n{tables}\n"));
    for (retries, tried) in [(0, false), (2, true)] {
        let outcome = bench.call(&format!(
            "run scene.toml --out out{retries} --set run.retries={retries} \
             --set phase.water.rheology.newtonian.viscosity=10"
        ));
        assert_eq!(outcome.code, Some(1), "{}", outcome.err);
        assert!(
            outcome.err.contains("implicit viscosity"),
            "{}",
            outcome.err
        );
        assert_eq!(outcome.err.contains("going back"), tried, "{}", outcome.err);
    }
}
