//! The number of threads changes the speed and not one bit of the result.

use sph_tests::{DAM_BREAK, END_OF_THE_STEP, PADDLE, SOIL, SUB_STEPS, bench, soil_with};

fn dam_break_with(tables: &str) -> String {
    format!("{DAM_BREAK}\n{tables}\n")
}

#[test]
fn dam_breaks_and_moving_walls_give_the_same_bits() {
    bench!(PADDLE).same_on_threads("");
    for tables in [
        "",
        "[surface.renormalised]",
        "[outlet.end]\nbeyond = 0.45",
        "[pressure.implicit]\n[surface.cone-test]",
    ] {
        bench!(&dam_break_with(tables)).same_on_threads("");
    }
}

#[test]
fn implicit_viscosities_give_the_same_bits_with_every_solver_and_scheme() {
    let euler = "[implicit-viscosity.backward-euler]";
    let blocks = "[viscous-operator.monaghan-gingold]";
    let half = "[implicit-viscosity.crank-nicolson]\n[integrator.leap-frog]";
    let solvers = ["cholesky", "conjugate-gradient", "automatic", "bicgstab"];
    let solvers = solvers.map(|solver| format!("{euler}\n[linear-solver.{solver}]"));
    let stiff = "--set phase.water.rheology.newtonian.viscosity=50";
    for tables in solvers.iter().chain([&format!("{blocks}\n{half}")]) {
        bench!(&dam_break_with(tables)).same_on_threads(stiff);
    }
    // Blocks, and outer iterations.
    let mud =
        "--set phase.water.rheology={carreau={rest_viscosity=50,relaxation_time=1,exponent=0.5}}";
    bench!(&dam_break_with(&format!("{blocks}\n{euler}"))).same_on_threads(mud);
}

#[test]
fn soils_with_displacements_stresses_of_the_end_of_the_step_and_sub_steps_give_the_same_bits() {
    for scene in [SOIL, &soil_with(END_OF_THE_STEP), &soil_with(SUB_STEPS)] {
        bench!(scene).same_on_threads("--set run.end=0.06");
    }
}
