//! The number of threads changes the speed and not one bit of the result.

use sph_tests::{DAM_BREAK, END_OF_THE_STEP, PADDLE, SOIL, SUB_STEPS, bench, soil_with};

fn same_for_all_threads(scene: &str, set: &str) {
    let bench = bench!(scene);
    let state = |threads: u32| {
        bench.done(&format!(
            "run scene.toml --quiet --out r{threads} --threads {threads} {set}"
        ));
        bench.state(&format!("r{threads}"))
    };
    let one = state(1);
    for threads in [2, 4] {
        one.assert_same(&state(threads), &format!("1 and {threads} threads"));
    }
}

#[test]
fn a_dam_break_gives_the_same_bits() {
    same_for_all_threads(DAM_BREAK, "");
}

#[test]
fn a_renormalised_surface_gives_the_same_bits() {
    same_for_all_threads(&format!("{DAM_BREAK}\n[surface.renormalised]\n"), "");
}

#[test]
fn an_outlet_gives_the_same_bits() {
    same_for_all_threads(&format!("{DAM_BREAK}\n[outlet.end]\nbeyond = 0.45\n"), "");
}

#[test]
fn a_moving_wall_gives_the_same_bits() {
    same_for_all_threads(PADDLE, "");
}

#[test]
fn an_implicit_viscosity_gives_the_same_bits_with_every_solver() {
    for solver in ["cholesky", "conjugate-gradient", "automatic"] {
        let tables = format!("[implicit-viscosity.backward-euler]\n[linear-solver.{solver}]");
        let stiff = "--set phase.water.rheology.newtonian.viscosity=50";
        same_for_all_threads(&format!("{DAM_BREAK}\n{tables}\n"), stiff);
    }
}

#[test]
fn a_pressure_of_the_end_of_the_step_gives_the_same_bits() {
    let tables = "[pressure.implicit]\n[surface.cone-test]";
    same_for_all_threads(&format!("{DAM_BREAK}\n{tables}\n"), "");
}

#[test]
fn blocks_outer_iterations_and_other_schemes_give_the_same_bits() {
    let blocks = "[viscous-operator.monaghan-gingold]";
    let mud =
        "--set phase.water.rheology={carreau={rest_viscosity=50,relaxation_time=1,exponent=0.5}}";
    let water = "--set phase.water.rheology.newtonian.viscosity=50";
    let half = "[implicit-viscosity.crank-nicolson]\n[integrator.leap-frog]";
    for (tables, set) in [
        (
            format!("{blocks}\n[implicit-viscosity.backward-euler]"),
            mud,
        ),
        (format!("{blocks}\n{half}"), water),
        (
            "[implicit-viscosity.backward-euler]\n[linear-solver.bicgstab]".into(),
            water,
        ),
    ] {
        same_for_all_threads(&format!("{DAM_BREAK}\n{tables}\n"), set);
    }
}

#[test]
fn stresses_of_the_end_of_the_step_and_of_sub_steps_give_the_same_bits() {
    for force in [END_OF_THE_STEP, SUB_STEPS] {
        same_for_all_threads(&soil_with(force), "--set run.end=0.06");
    }
}

#[test]
fn a_soil_that_remembers_displacements_gives_the_same_bits() {
    same_for_all_threads(SOIL, "--set run.end=0.06");
}
