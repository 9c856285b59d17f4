//! What an implicit scene must not ask for.

use sph_tests::{DAM_BREAK, bench};

#[test]
fn solves_of_nothing_and_unknown_solvers_are_refused() {
    let solve = "[implicit-viscosity.backward-euler]";
    let misspelt = format!("{solve}\n[linear-solver.cholesski]");
    let viscosity = "--set phase.water.rheology.newtonian.viscosity";
    let nothing = "nothing to solve for | implicit-viscosity";
    for (tables, set, told) in [
        (solve, format!("{viscosity}=0"), nothing),
        (solve, format!("{viscosity}=-1"), "viscosity"),
        (
            "[linear-solver.cholesky]",
            "".into(),
            "linear-solver.cholesky",
        ),
        (&misspelt, "".into(), "cholesky"),
    ] {
        let bench = bench!(&format!("{DAM_BREAK}\n{tables}\n"));
        bench.refused(&format!("check scene.toml {set}")).says(told);
    }
}

/// With tries left the step is repeated with half of its length, without any the run says why it stops.
#[test]
fn a_solver_that_gives_up_stops_the_run_with_its_reason() {
    let tables = "[implicit-viscosity.backward-euler]\n[linear-solver.conjugate-gradient]\n\
         iterations = 1\ntolerance = 1e-14";
    let bench = bench!(&format!("{DAM_BREAK}\n{tables}\n"));
    for (retries, tried) in [(0, false), (2, true)] {
        let outcome = bench.failed(&format!(
            "run scene.toml --out out{retries} --set run.retries={retries} \
             --set phase.water.rheology.newtonian.viscosity=10"
        ));
        // How far it came: the first residual and that of its one iteration.
        outcome.says("implicit viscosity | in 1 iterations (residuals: ");
        assert_eq!(outcome.err.contains("going back"), tried, "{}", outcome.err);
    }
}

/// The dam break with oil in a box, of friction from the end of the step.
fn with_oil(viscosity: &str, oil: &str, rest: &str) -> String {
    format!(
        r#"{DAM_BREAK}
{rest}
[implicit-viscosity.backward-euler]
[phase.oil]
density = 900.0
velocity_scale = 3.0
[phase.oil.rheology.newtonian]
viscosity = {viscosity}
[body.oil]
phase = "oil"
box = {oil}
[probe.oil]
kind = "extent"
phase = "oil"
axis = "y"
"#
    )
}

/// A row of the system without any other particle: it falls 0.5 g t² = 0.049 m.
#[test]
fn a_lone_particle_of_a_second_phase_falls_freely() {
    let scene = with_oil("0.1", "[[0.4, 0.4], [0.44, 0.44]]", "");
    let bench = bench!(&scene);
    bench.done("run scene.toml --out out --set run.end=0.1");
    let fallen = 0.41 - bench.series("out").last("oil.lowest");
    assert!((fallen - 0.04905).abs() < 0.0005, "fell by {fallen} m");
}

/// All its neighbours are of the other phase, and a million times less viscous: it goes down with the column around it.
#[test]
fn a_lone_particle_within_another_phase_is_carried() {
    let hole = "subtract = [{ box = [[0.08, 0.2], [0.12, 0.24]] }]";
    let column = "pressure = \"hydrostatic\"";
    let scene = with_oil("1e3", "[[0.08, 0.2], [0.12, 0.24]]", "");
    let scene = scene.replacen(column, &format!("{column}\n{hole}"), 1);
    let bench = bench!(&scene);
    bench.done("run scene.toml --out out --set run.end=0.3 --set output.every=0.3");
    let at = bench.series("out").last("oil.lowest");
    assert!((0.05..0.15).contains(&at), "it is at {at} m");
}

/// Phases of no viscosity are rows of their own mass; the other one is solved for.
#[test]
fn one_of_two_phases_without_viscosity_runs_like_one_of_little() {
    let floor = |water: &str| {
        let scene = with_oil("1.0", "[[0.2, 0.0], [0.4, 0.2]]", "");
        let bench = bench!(&scene);
        bench.done(&format!(
            "run scene.toml --out out --set run.end=0.1 --set phase.water.rheology.newtonian.viscosity={water}"
        ));
        bench.series("out").last("front")
    };
    let (none, little) = (floor("0"), floor("1e-9"));
    assert!((none / little - 1.0).abs() < 1e-6, "{none} m, {little} m");
}
