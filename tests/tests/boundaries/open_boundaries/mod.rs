//! Fluid that comes in and goes out through walls, `[wall.NAME.open-boundary.PLUGIN]`.

mod current;
mod in_space;
mod pulse;
mod still_water;

use serde_json::Value as Json;
use sph_core::{SceneProblem, fields};
use sph_particles::setup::assemble;
use sph_particles::{Stepper, Summary};
use sph_scene::parse;
use sph_solver::SolverError;
use sph_tests::{Ran, assembled, finished, near, refusals, same_bits, scene};

/// A channel of ten rows between an inlet and an outlet, `MORE` for what a test adds to either.
const CHANNEL: &str = include_str!("channel.toml");

/// What passed the faces, of which nothing is missing.
fn passed(summary: &Summary) -> &Json {
    let passed = &summary.counts["open_boundaries"];
    let unbalanced = passed["unbalanced"].as_f64().expect("a number");
    assert!(unbalanced < 1e-12, "{unbalanced:e} is missing");
    passed
}

fn number(of: &Json, face: &str, key: &str) -> f64 {
    of[face][key].as_f64().unwrap_or(0.0)
}

/// entered − left − held of every face less what particles there are more than the `first`, four sums of their own,
/// over what entered.
fn missing(run: &Ran, first: f64) -> f64 {
    let passed = passed(&run.summary);
    let faces = ["inlet.mud", "outlet.mud", "outlet.water"];
    let sum = |key: &str| faces.iter().map(|f| number(passed, f, key)).sum::<f64>();
    let mass = run.state().reals("mass").iter().sum::<f64>();
    (sum("entered") - sum("left") - sum("held") - (mass - first)) / sum("entered")
}

/// A flow of 1 m/s along x, without friction and the same everywhere, stays as it is.
fn stays_uniform<const D: usize>(run: &Ran) {
    let velocity = run.state().reals("velocity");
    let off = velocity.chunks(D).map(|u| {
        let across = u[1..]
            .iter()
            .fold(u[0] - 1.0, |size, across| size.hypot(*across));
        across.abs()
    });
    let off = off.fold(0.0, f64::max);
    let [least, largest] = run.summary.density_range;
    println!("velocity off by {off}, density {least} to {largest}");
    // A density that is off by 0.1 % is a pressure of 0.144 ρu²; sound of this strength moves particles by 0.001 c.
    assert!(off < 0.012, "velocity off by {off}");
    assert!(least > 0.999 && largest < 1.001, "{least} to {largest}");
}

/// entered − left − held of every face, and what particles there are, are four sums of their own.
#[test]
fn inflow_less_outflow_is_the_change_of_mass() {
    let run = finished(CHANNEL, 2);
    let passed = passed(&run.summary);
    let entered = number(passed, "inlet.mud", "entered");
    // ρ u H t, with the density that the pressure at the face makes.
    near(entered, 1.6 * 0.6, 0.02, "kg/m that came in");
    let missing = missing(&run, 200.0 * 0.01);
    assert!(missing.abs() < 1e-12, "{missing:e} of it is missing");
    assert!(number(passed, "outlet.water", "died") > 0.3, "{passed}");
    // The summary counts the same deaths and births.
    let summary = &run.summary;
    assert!(summary.drift.mass.abs() < 1e-13, "{:e}", summary.drift.mass);
    let left = &summary.left["open.outlet.water"];
    assert!(left.particles > 30 && summary.escaped == 0, "{left:?}");
}

#[test]
fn particles_come_and_go_at_the_same_step_with_the_same_bits_on_any_threads_and_resumed() {
    same_bits(CHANNEL, 60, &[2, 4], |_| ());
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
    stays_uniform::<2>(&finished(&text, 2));
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
    let particles = finished(&text, 2).state().columns["mass"].len();
    // Half a row of eight before either face is in a port or not.
    assert!(particles.abs_diff(160) <= 8, "{particles} for 160");
}

/// Water that runs to a level, 11 rows deep.
const LEVEL: &str = include_str!("level.toml");

/// Elements above the level have fluid before a part of them at most, and no more of it may pass than there is: ports that owed
/// five particles each threw those beside them up with 2.5 m/s.
#[test]
fn water_is_not_thrown_up_where_it_leaves_below_a_level() {
    let fastest = finished(LEVEL, 1).series().largest("largest_speed");
    // Bernoulli: water from the floor that comes out at the surface has no more.
    let most = (0.61_f64.powi(2) + 2.0 * 9.81 * 0.22).sqrt();
    assert!(fastest < most, "{fastest} m/s, {most} m/s at most");
}

/// Problems of a scene, as a user sees them.
fn problems<const D: usize>(text: &str) -> Vec<SceneProblem> {
    let loaded = match parse(text, "scene.toml", &[]) {
        Ok(loaded) => loaded,
        Err(refused) => {
            let all = refused.diagnostics.into_iter();
            return all.map(|d| SceneProblem::new(d.path, d.message)).collect();
        }
    };
    match assemble::<D>(&loaded.scene) {
        Err(SolverError::Scene(problems)) => problems,
        Err(other) => panic!("{other}"),
        Ok(_) => panic!("it was let through"),
    }
}

/// A scene is refused at a key.
fn assert_refused<const D: usize>(text: &str, path: &str, why: &str) {
    let all = problems::<D>(text);
    let found = |p: &SceneProblem| p.path == path && p.message.contains(why);
    assert!(all.iter().any(found), "{all:?}");
}

#[test]
fn invalid_faces_are_refused_at_their_key() {
    for case in refusals(include_str!("faces.refused")) {
        assert_refused::<2>(&case.of(CHANNEL), case.at, case.said[0]);
    }
    let block =
        "[wall.block]\nbox = [[0.02, 0.42], [0.33, 0.73]]\nfluid = \"outside\"\n[phase.water]";
    let body = "box = [[0.0, 0.0], [2.0, 1.0]]";
    let blocked = CHANNEL.replace("[phase.water]", block);
    let blocked = blocked.replace(body, &format!("{body}\nclip = true"));
    let inlet = "wall.inlet.open-boundary.velocity-inlet";
    assert_refused::<2>(&blocked, inlet, "blocked at the start");
}

#[test]
fn a_closed_box_with_an_inlet_is_told() {
    let text = CHANNEL.replace(
        "[wall.outlet.open-boundary.outflow]\nmemory = \"1 s\"\n",
        "",
    );
    let parts = assembled::<2>(&scene(&text, &[]));
    let told = parts.warnings.iter().any(|w| w.contains("none can leave"));
    assert!(told, "{:?}", parts.warnings);
}
