//! Fluid that comes in and goes out through walls, `[wall.NAME.open-boundary.PLUGIN]`.

mod current;
mod pulse;
mod still_water;

use std::path::Path;

use serde_json::Value as Json;
use sph_core::{SceneProblem, fields};
use sph_particles::setup::assemble;
use sph_particles::{Stepper, Summary, run};
use sph_run::{Identity, RunOptions, Start};
use sph_scene::parse;
use sph_solver::SolverError;
use sph_tests::FinalState;

/// A column of the series that a run has written, by the beginning of its name.
fn series(folder: &Path, name: &str) -> Vec<f64> {
    let text = std::fs::read_to_string(folder.join("series.csv")).expect("a series");
    let mut lines = text.lines();
    let mut head = lines.next().expect("a head").split(',');
    let column = head.position(|c| c.starts_with(name));
    let column = column.unwrap_or_else(|| panic!("no column {name}"));
    let number = |line: &str| line.split(',').nth(column).and_then(|n| n.parse().ok());
    lines.map(|l| number(l).expect("a number")).collect()
}

/// A channel of ten rows between an inlet and an outlet, `MORE` for what a test adds to either.
const CHANNEL: &str = r#"
title = "an open channel"
dimension = 2
[run]
end = 0.6
checkpoint_every = 0.1
[numerics]
spacing = 0.1
[kernel.wendland-c2]
[formulation.hu-adams]
[integrator.symplectic-euler]
[smoother.brezzi-pitkaranta]
strength = 0.04
[walls.usaw]
vertices = false
[wall.bottom]
polyline = [[0.0, 0.0], [2.0, 0.0]]
[wall.outlet]
polyline = [[2.0, 0.0], [2.0, 1.0]]
[wall.outlet.open-boundary.outflow]
memory = "1 s"
[wall.top]
polyline = [[2.0, 1.0], [0.0, 1.0]]
[wall.inlet]
polyline = [[0.0, 1.0], [0.0, 0.0]]
[wall.inlet.open-boundary.velocity-inlet]
velocity = "1 m/s"
phase = "mud"
[phase.water]
density = 1.0
speed_of_sound = 12.0
rheology.newtonian = { viscosity = "0.01 Pa s" }
[phase.mud]
density = 1.6
speed_of_sound = 12.0
rheology.newtonian = { viscosity = "0.1 Pa s" }
[body.water]
phase = "water"
box = [[0.0, 0.0], [2.0, 1.0]]
velocity = [1.0, 0.0]
[probe.passed]
kind = "passed"
[output]
every = 0.6
vtk = false
"#;

fn into(folder: &Path, text: &str, threads: usize, start: Start) -> Summary {
    let loaded = parse(text, "scene.toml", &[]).unwrap_or_else(|e| panic!("{e}"));
    let options = RunOptions::new(folder, Identity::of_text(CHANNEL))
        .start(start)
        .threads(threads);
    run(&loaded.scene, &options, &mut ()).unwrap_or_else(|e| panic!("{e}"))
}

fn folder() -> tempfile::TempDir {
    tempfile::tempdir().expect("a folder")
}

fn number(of: &Json, face: &str, key: &str) -> f64 {
    of[face][key].as_f64().unwrap_or(0.0)
}

/// entered − left − held of every face, and what particles there are, are four sums of their own.
#[test]
fn inflow_less_outflow_is_the_change_of_mass() {
    let out = folder();
    let summary = into(out.path(), CHANNEL, 2, Start::Afresh);
    let passed = &summary.counts["open_boundaries"];
    let unbalanced = passed["unbalanced"].as_f64().expect("a number");
    assert!(
        unbalanced < 1e-12,
        "{unbalanced:e} of what passed is missing"
    );
    let entered = number(passed, "inlet.mud", "entered");
    // ρ u H t, with the density that the pressure at the face makes.
    assert!(
        (entered / (1.6 * 0.6) - 1.0).abs() < 0.02,
        "{entered} kg/m came in"
    );
    let faces = ["inlet.mud", "outlet.mud", "outlet.water"];
    let sum = |key: &str| faces.iter().map(|f| number(passed, f, key)).sum::<f64>();
    let state = FinalState::read(out.path());
    let mass = state.columns["mass"]
        .iter()
        .map(|b| f64::from_bits(*b))
        .sum::<f64>();
    let first = 200.0 * 0.01;
    let missing = sum("entered") - sum("left") - sum("held") - (mass - first);
    assert!(
        missing.abs() < 1e-12 * sum("entered"),
        "{missing:e} kg/m is missing"
    );
    assert!(number(passed, "outlet.water", "died") > 0.3, "{passed}");
    // The summary counts the same deaths and births.
    assert!(summary.drift.mass.abs() < 1e-13, "{:e}", summary.drift.mass);
    let left = &summary.left["open.outlet.water"];
    assert!(left.particles > 30 && summary.escaped == 0, "{left:?}");
}

#[test]
fn particles_come_and_go_at_the_same_step_with_the_same_bits_on_any_threads_and_resumed() {
    let outs: Vec<_> = (0..4).map(|_| folder()).collect();
    let path = |k: usize| outs[k].path();
    into(path(0), CHANNEL, 1, Start::Afresh);
    let whole = FinalState::read(path(0));
    for (k, threads) in [(1, 2), (2, 4)] {
        into(path(k), CHANNEL, threads, Start::Afresh);
        FinalState::read(path(k)).assert_same(&whole, &format!("{threads} threads"));
    }
    let part = CHANNEL.replace("end = 0.6\n", "end = 0.6\nmax_steps = 60\n");
    into(path(3), &part, 1, Start::Afresh);
    into(path(3), CHANNEL, 2, Start::Resumed);
    FinalState::read(path(3)).assert_same(&whole, "resumed");
}

/// A channel without friction with a flow that is the same everywhere: nothing may change it.
#[test]
fn a_uniform_flow_passes_both_faces_as_if_they_were_not_there() {
    let text = CHANNEL
        .replace("phase = \"mud\"\n", "phase = \"water\"\n")
        .replace("[wall.bottom]", "[wall.bottom]\ncondition = \"free-slip\"")
        .replace("[wall.top]", "[wall.top]\ncondition = \"free-slip\"")
        .replace("end = 0.6", "end = 3.0")
        .replace("every = 0.6", "every = 3.0");
    let out = folder();
    let summary = into(out.path(), &text, 2, Start::Afresh);
    let state = FinalState::read(out.path());
    let velocity: Vec<f64> = state.columns["velocity"]
        .iter()
        .map(|b| f64::from_bits(*b))
        .collect();
    let off = velocity
        .chunks(2)
        .map(|u| (u[0] - 1.0).hypot(u[1]))
        .fold(0.0, f64::max);
    let [least, largest] = summary.density_range;
    // A density that is off by 0.1 % is a pressure of 0.144 ρu²; sound of this strength moves particles by 0.001 c.
    assert!(
        off < 0.012 && least > 0.999 && largest < 1.001,
        "velocity off by {off}, density {least} to {largest}"
    );
}

/// Between walls with friction the rows beside them are slow, and a background pressure drives all particles to where they
/// lack neighbours: 46 too many gathered before the outlet while those that wait behind it were not counted with its ports.
#[test]
fn slow_rows_do_not_gather_before_an_outlet() {
    let text = CHANNEL
        .replace("phase = \"mud\"\n", "phase = \"water\"\n")
        .replace("end = 0.6", "end = 8.0")
        .replace("every = 0.6", "every = 8.0")
        .replace("[0.0, 1.0]", "[0.0, 0.8]")
        .replace("[2.0, 1.0]", "[2.0, 0.8]")
        .replace(
            "velocity = \"1 m/s\"",
            "velocity = \"1.5 m/s\"\nprofile = \"parabola\"",
        )
        .replace("[integrator", "[viscous-operator.morris]\n[integrator")
        .replace(
            "[phase.water]",
            "[phase.water]\nequation-of-state.tait = { background_pressure = 8 }",
        )
        .replace(
            "[phase.mud]",
            "[phase.mud]\nequation-of-state.tait = { background_pressure = 8 }",
        )
        .replace("\"0.01 Pa s\"", "\"0.016 Pa s\"")
        .replace("speed_of_sound = 12.0", "speed_of_sound = 15.0");
    let out = folder();
    into(out.path(), &text, 2, Start::Afresh);
    let particles = FinalState::read(out.path()).columns["mass"].len();
    // Half a row of eight before either face is in a port or not.
    assert!(
        particles.abs_diff(160) <= 8,
        "{particles} particles where 160 have room"
    );
}

/// Water that runs to a level, 11 rows deep.
const LEVEL: &str = r#"
title = "a level behind an outlet"
dimension = 2
[run]
end = 1.2
[numerics]
spacing = "20 mm"
gravity = [0.0, -9.81]
[formulation.colagrossi-landrini]
[integrator.symplectic-euler]
[viscous-operator.monaghan-gingold]
[smoother.delta-sph]
[walls.usaw]
vertices = false
[wall.back]
polyline = [[0.0, 0.8], [0.0, 0.22]]
[wall.inlet]
polyline = [[0.0, 0.22], [0.0, 0.0]]
[wall.inlet.open-boundary.velocity-inlet]
velocity = "0.61 m/s"
[wall.floor]
polyline = [[0.0, 0.0], [0.6, 0.0]]
condition = "free-slip"
[wall.tail]
polyline = [[0.6, 0.0], [0.6, 0.4]]
[wall.tail.open-boundary.level]
level = "0.22 m"
[wall.above]
polyline = [[0.6, 0.4], [0.6, 0.8]]
[phase.water]
density = 1000.0
speed_of_sound = 25.0
equation-of-state.tait = { tension_limit = 0 }
rheology.newtonian = { viscosity = "0.05 Pa s" }
[body.water]
phase = "water"
box = [[0.0, 0.0], [0.6, 0.22]]
pressure = "hydrostatic"
velocity = [0.61, 0.0]
[output]
every = 2
series_every = 0.02
vtk = false
"#;

/// Elements above the level have fluid before a part of them at most, and no more of it may pass than there is: ports that owed
/// five particles each threw those beside them up with 2.5 m/s.
#[test]
fn water_is_not_thrown_up_where_it_leaves_below_a_level() {
    let folder = folder();
    into(folder.path(), LEVEL, 1, Start::Afresh);
    let series = std::fs::read_to_string(folder.path().join("series.csv")).expect("a series");
    let mut rows = series
        .lines()
        .map(|line| line.split(',').collect::<Vec<_>>());
    let head = rows.next().expect("a head");
    let of_speed = head.iter().position(|c| *c == "largest_speed[m/s]");
    let column = of_speed.expect("a column of the largest speed");
    let speeds = rows.map(|row| row[column].parse::<f64>().expect("a speed"));
    let fastest = speeds.fold(0.0, f64::max);
    // Bernoulli: water from the floor that comes out at the surface has no more.
    let most = (0.61_f64.powi(2) + 2.0 * 9.81 * 0.22).sqrt();
    assert!(fastest < most, "{fastest} m/s, {most} m/s at most");
}

/// Problems of a scene, as a user sees them.
fn problems(text: &str) -> Vec<SceneProblem> {
    let loaded = match parse(text, "scene.toml", &[]) {
        Ok(loaded) => loaded,
        Err(refused) => {
            let all = refused.diagnostics.into_iter();
            return all.map(|d| SceneProblem::new(d.path, d.message)).collect();
        }
    };
    match assemble::<2>(&loaded.scene) {
        Err(SolverError::Scene(problems)) => problems,
        Err(other) => panic!("{other}"),
        Ok(_) => panic!("it was let through"),
    }
}

fn assert_refused(text: &str, path: &str, why: &str) {
    let all = problems(text);
    let found = all
        .iter()
        .any(|p| p.path == path && p.message.contains(why));
    assert!(found, "{all:?}");
}

#[test]
fn invalid_faces_are_refused_at_their_key() {
    let inlet = "wall.inlet.open-boundary.velocity-inlet";
    let with = |a: &str, b: &str| CHANNEL.replace(a, b);
    let fast = with("velocity = \"1 m/s\"", "velocity = \"15 m/s\"");
    assert_refused(&fast, &format!("{inlet}.velocity"), "speed of sound is 12");
    let short = with("phase = \"mud\"\n", "over_time = [[0, 0], [0.5, 1]]\n");
    assert_refused(&short, &format!("{inlet}.over_time"), "from 0 s to 0.5 s");
    let unknown = with("phase = \"mud\"\n", "phase = \"mudd\"\n");
    assert_refused(&unknown, &format!("{inlet}.phase"), "`mud`");
    let values = with("phase = \"mud\"\n", "values = { turbulence = 1.0 }\n");
    assert_refused(&values, &format!("{inlet}.values.turbulence"), "no plugin");
    let vertices = with("vertices = false", "vertices = true");
    assert_refused(
        &vertices,
        "wall.inlet.open-boundary.velocity-inlet",
        "vertices = false",
    );
    let level = with(
        "[wall.outlet.open-boundary.outflow]\nmemory = \"1 s\"",
        "[wall.outlet.open-boundary.level]\nlevel = 0.5",
    );
    assert_refused(
        &level,
        "wall.outlet.open-boundary.level.level",
        "needs gravity",
    );
    let nothing = with("memory = \"1 s\"", "pressure = 0");
    assert_refused(&nothing, "wall.outlet.open-boundary.outflow", "`memory`");
    let blocked = with(
        "[phase.water]",
        "[wall.block]\nbox = [[0.02, 0.42], [0.33, 0.73]]\nfluid = \"outside\"\n[phase.water]",
    )
    .replace(
        "box = [[0.0, 0.0], [2.0, 1.0]]",
        "box = [[0.0, 0.0], [2.0, 1.0]]\nclip = true",
    );
    assert_refused(&blocked, inlet, "blocked at the start");
    let turbulent = with(
        "integrator.symplectic-euler",
        "integrator.predictor-corrector",
    );
    assert_refused(
        &turbulent,
        "integrator.predictor-corrector",
        "once per step",
    );
}

#[test]
fn a_closed_box_with_an_inlet_is_told() {
    let text = CHANNEL.replace(
        "[wall.outlet.open-boundary.outflow]\nmemory = \"1 s\"\n",
        "",
    );
    let loaded = parse(&text, "scene.toml", &[]).unwrap_or_else(|e| panic!("{e}"));
    let parts = assemble::<2>(&loaded.scene).unwrap_or_else(|e| panic!("{e}"));
    let told = parts.warnings.iter().any(|w| w.contains("none can leave"));
    assert!(told, "{:?}", parts.warnings);
}
