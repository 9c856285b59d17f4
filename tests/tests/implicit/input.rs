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
