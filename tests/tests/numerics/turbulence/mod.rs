//! Closures and wall functions in whole scenes.

mod inlet;
mod phases;
mod probes;
mod refusals;
mod strains;

use sph_core::{System, Vect, fields};
use sph_neighbours::World;
use sph_particles::setup::Assembled;
use sph_run::Start;
use sph_tests::{
    FinalState, PERIODIC, Says, bench, finished, move_as, near, ran, run_into, scene, within,
};
use sph_turbulence::{
    DISSIPATION, FRICTION_VELOCITY, Smagorinsky, TURBULENT_ENERGY, WALL_DISTANCE, WallLaw,
};

/// Water over a bed along x, without gravity.
const CHANNEL: &str = include_str!("channel.toml");

/// The same in space.
fn in_space() -> String {
    CHANNEL
        .replace("dimension = 2", "dimension = 3")
        .replace(
            "periodic = { x = [0.0, 0.2] }",
            "periodic = { x = [0.0, 0.1], y = [0.0, 0.1] }",
        )
        .replace(
            "polyline = [[0.0, 0.0], [0.2, 0.0]]",
            "box = [[0.0, 0.0, 0.0], [0.1, 0.1, 0.1]]\nopen = [\"x-\", \"x+\", \"y-\", \"y+\", \"z+\"]",
        )
        .replace(
            "box = [[0.0, 0.0], [0.2, 0.2]]",
            "box = [[0.0, 0.0, 0.0], [0.1, 0.1, 0.1]]",
        )
        .replace("velocity = [1.0, 0.0]", "velocity = [0.8, 0.6, 0.0]")
}

fn assembled<const D: usize>(text: &str, changes: &[&str]) -> Assembled<D> {
    sph_tests::assembled(&scene(text, changes))
}

/// With the rates of the start.
fn evaluated<const D: usize>(text: &str, changes: &[&str]) -> World<D> {
    sph_tests::evaluated(&scene(text, changes)).flow.world
}

/// A run that stops after 20 steps and goes on with two threads.
fn in_two_parts(text: &str) -> tempfile::TempDir {
    let folder = tempfile::tempdir().expect("a folder");
    let begun = run_into(
        folder.path(),
        &scene(text, &["run.max_steps=20"]),
        1,
        Start::Afresh,
    );
    begun.unwrap_or_else(|e| panic!("{e}"));
    let whole = run_into(folder.path(), &scene(text, &[]), 2, Start::Resumed);
    whole.unwrap_or_else(|e| panic!("{e}"));
    folder
}

/// η_t/ρ of the particles of a lattice that moves as given, away from its edges, m²/s; and h.
fn eddies(closure: &str, velocity: impl Fn(&Vect<2>) -> Vect<2>) -> (Vec<f64>, f64) {
    let open = PERIODIC.replace("periodic = { x = [0.0, 1.0], y = [0.0, 1.0] }", "");
    let text = format!("{open}\n{closure}");
    let mut parts = assembled::<2>(&text, &[]);
    move_as(&mut parts, velocity);
    parts.flow.evaluate().expect("an evaluation");
    let world = &parts.flow.world;
    let reach = world.kernel.support_radius();
    let inside = |x: &Vect<2>| x.iter().all(|c| *c > reach && *c < 1.0 - reach);
    let eddies = world.free.get(fields::EDDY_VISCOSITY).expect("eddies");
    let density = world.free.get(fields::DENSITY).expect("densities");
    // Sorting may have moved particles.
    let places = world.free.get(fields::POSITION).expect("places");
    let wanted = (0..places.len()).filter(|i| inside(&places[*i]));
    let values: Vec<f64> = wanted.map(|i| eddies[i] / density[i]).collect();
    assert!(!values.is_empty());
    (values, world.kernel.smoothing_length())
}

const SMAGORINSKY: &str = "[eddy-viscosity.smagorinsky]";
const WALE: &str = "[eddy-viscosity.wale]";
/// Gradients that are exact for linear velocities leave rounding.
const ROUNDING: f64 = 1e-10;

#[test]
fn a_sheared_box_has_smagorinskys_eddies_and_none_of_wale() {
    let rate = 3.0;
    let shear = |x: &Vect<2>| Vect::from([rate * x.y, 0.0]);
    let (found, h) = eddies(SMAGORINSKY, shear);
    let exact = (0.1 * 2.0 * h).powi(2) * rate;
    for value in found {
        assert!((value / exact - 1.0).abs() < ROUNDING, "{value}, {exact}");
    }
    let (found, _) = eddies(WALE, shear);
    assert!(found.iter().all(|v| *v < ROUNDING * exact), "{found:?}");
}

#[test]
fn solid_rotation_has_no_eddies_of_smagorinskys() {
    let turn = |x: &Vect<2>| Vect::from([-3.0 * (x.y - 0.5), 3.0 * (x.x - 0.5)]);
    let (found, h) = eddies(SMAGORINSKY, turn);
    let scale = (0.1 * 2.0 * h).powi(2) * 3.0;
    assert!(found.iter().all(|v| *v < ROUNDING * scale), "{found:?}");
}

#[test]
fn large_eddies_in_the_plane_are_warned_of() {
    let bench = bench!(&format!("{PERIODIC}\n{WALE}\n"));
    let outcome = bench.done("run scene.toml");
    (outcome.out + &outcome.err).says("in two its results");
}

/// In the first evaluation the fluid slides as one, so that every particle has the u* of 1 m/s at its distance.
#[test]
fn particles_near_the_bed_have_the_friction_velocity_of_their_true_distance() {
    for (text, roughness) in [(CHANNEL, 0.0), (CHANNEL, 0.005)] {
        let change = format!("wall-function.log-law.roughness={roughness}");
        let world = evaluated::<2>(text, &[&change]);
        let law = WallLaw {
            roughness,
            ..WallLaw::default()
        };
        check_friction_velocities(&world, &law);
    }
    let world = evaluated::<3>(&in_space(), &[]);
    check_friction_velocities(&world, &WallLaw::default());
}

fn check_friction_velocities<const D: usize>(world: &World<D>, law: &WallLaw) {
    let places = world.free.get(fields::POSITION).expect("places");
    let friction = world.free.get(FRICTION_VELOCITY).expect("u*");
    let mut counted = 0;
    for (x, found) in places.iter().zip(friction) {
        let z = x[D - 1];
        if z < world.kernel.support_radius() * 0.99 {
            let exact = law.friction_velocity(1.0, z, 1e-6).expect("u*");
            assert!((found / exact - 1.0).abs() < 1e-9, "{z}: {found}, {exact}");
            counted += 1;
        } else if z > world.kernel.support_radius() * 1.01 {
            assert_eq!(*found, 0.0);
        }
    }
    assert!(counted > 0);
}

/// What the bed takes is what the fluid loses; a bed that goes along takes nothing.
#[test]
fn the_shear_is_a_force_and_its_reaction() {
    assert!(finished(CHANNEL, 2).last("shear.x") > 0.0);
    // 0.8 and 0.6 m/s along a floor in space: the lattice has both axes alike.
    let run = finished(&in_space(), 2);
    let [x, y] = ["shear.x", "shear.y"].map(|c| run.last(c));
    assert!(x > 0.0 && (y / x - 0.75).abs() < 1e-6, "{x}, {y}");
    let along = CHANNEL.replace(
        "condition = \"free-slip\"",
        "condition = \"free-slip\"\nvelocity = [1.0, 0.0]",
    );
    assert_ne!(along, CHANNEL);
    let run = finished(&along, 1);
    let [force, friction] = ["shear.x", "bed"].map(|c| run.last(c));
    // Of the pressure noise of a lattice at rest in its own frame: none.
    assert!(force.abs() < 1e-9 && friction < 1e-4, "{force}, {friction}");
}

/// d(Σmu)/dt = −F: over a run with the force at every step.
#[test]
fn momentum_goes_to_the_bed() {
    let each = CHANNEL.replace("every = 0.02", "every = 0.02\nseries_every = 1e-9");
    let series = finished(&each, 1).series();
    let [time, momentum, force] = series.columns(["time", "momentum.x", "shear.x"]);
    let taken = (1..time.len()).map(|k| force[k - 1] * (time[k] - time[k - 1]));
    let (taken, lost) = (taken.sum::<f64>(), momentum[0] - momentum[time.len() - 1]);
    assert!(lost > 0.0 && time.len() > 10);
    // Rounding of momenta of 40 kg m/s that lose some thousandths; forces of the beginning of every step.
    assert!((taken / lost - 1.0).abs() < 1e-6, "{taken} of {lost} N s/m");
}

#[test]
fn distances_are_true_ones() {
    let closure = "[eddy-viscosity.mixing-length]\nlongest = \"1 m\"\n";
    let world = evaluated::<2>(&format!("{CHANNEL}{closure}"), &[]);
    let places = world.free.get(fields::POSITION).expect("places");
    let distance = world.free.get(WALL_DISTANCE).expect("distances");
    for (x, z) in places.iter().zip(distance) {
        assert!((x.y - z).abs() < 1e-12, "{z} at {x}");
    }
}

/// η_t over the undamped one is f² with the mean u* of the particles near the bed, which lies between the least and the largest.
#[test]
fn van_driests_damping_has_the_friction_velocity_of_the_bed() {
    let plain = CHANNEL
        .replace("condition = \"free-slip\"", "")
        .replace("[wall-function.log-law]\nwalls = [\"bed\"]\n", "")
        .replace(
            "[probe.bed]\nkind = \"friction-velocity\"\nwall = \"bed\"\n",
            "",
        )
        .replace("1 mPa s", "0.1 Pa s");
    let eddies = |damping: &str| {
        let closure = format!("{SMAGORINSKY}\ndamping = \"{damping}\"\n");
        let world = evaluated::<2>(&format!("{plain}{closure}"), &[]);
        let eddies = world.free.get(fields::EDDY_VISCOSITY).expect("eddies");
        (eddies.to_vec(), world)
    };
    let ((damped, world), (undamped, _)) = (eddies("van-driest"), eddies("none"));
    let places = world.free.get(fields::POSITION).expect("places");
    let near = places
        .iter()
        .filter(|x| x.y < world.kernel.support_radius());
    let law = WallLaw::default();
    let all = near.map(|x| law.friction_velocity(1.0, x.y, 1e-4).expect("u*"));
    let all: Vec<f64> = all.collect();
    let least = all.iter().copied().fold(f64::INFINITY, f64::min);
    let largest = all.iter().copied().fold(0.0, f64::max);
    for (i, x) in places
        .iter()
        .enumerate()
        .filter(|(i, _)| undamped[*i] > 1e-9)
    {
        let share = damped[i] / undamped[i];
        let [low, high] = [least, largest].map(|u| Smagorinsky::damped(x.y * u / 1e-4).powi(2));
        within(share, low - 1e-12..=high + 1e-12, &format!("at {x}"));
    }
}

/// Page §4.10 `k-eps-decay`: k = k₀(1 + 0.92 ε₀t/k₀)^{−1/0.92}, to 1e-3, in a periodic box at rest.
#[test]
fn homogeneous_turbulence_decays_as_the_model_says() {
    let decay = PERIODIC
        .replace("velocity = [1.0, 0.5]", "")
        .replace("end = 0.1", "end = 0.5\nsafety = 0.05")
        .replace(
            "fields = [\"velocity\"]",
            "fields = [\"turbulent_energy\", \"dissipation\"]",
        )
        .replace("viscosity = 1.0", "viscosity = \"1 mPa s\"");
    let closure = "[eddy-viscosity.k-epsilon]\nenergy = 0.02\ndissipation = 0.05\n[probe.k]\nkind = \"range\"\nfield = \
                   \"turbulent_energy\"\n";
    let text = format!("{decay}\n{closure}");
    let run = finished(&text, 1);
    let exact = 0.02 * (1.0f64 + 0.92 * 0.05 * 0.5 / 0.02).powf(-1.0 / 0.92);
    for end in ["k.min", "k.max"] {
        near(run.last(end), exact, 1e-3, end);
    }
    let other = finished(&text, 2).state();
    run.state().assert_same(&other, "one and two threads");
}

/// Walls, closures, transported scalars and flow control together are the same bits on any number of threads and after a
/// resumption, and positive.
#[test]
fn a_channel_of_all_of_it_is_the_same_on_any_number_of_threads() {
    let rest = "[eddy-viscosity.k-epsilon.channel]\nfriction_velocity = 0.05\ndepth = 0.2\n\
                [flow-control.bulk-velocity]\nvelocity = 1.0\n";
    let text = format!("{CHANNEL}{rest}");
    let runs = [1, 2].map(|threads| finished(&text, threads));
    let state = runs[0].state();
    state.assert_same(&runs[1].state(), "one and two threads");
    let resumed = FinalState::read(in_two_parts(&text).path());
    state.assert_same(&resumed, "whole and resumed");
    let least = |state: &FinalState, name: &str| {
        let values = state.reals(name).into_iter();
        values.min_by(f64::total_cmp).expect("values")
    };
    for name in [TURBULENT_ENERGY.name, DISSIPATION.name] {
        assert!(least(&state, name) > 0.0, "{name}");
    }
    // With forces of a mean over a step, too, and solved for.
    for change in [
        "integrator.predictor-corrector={}",
        "implicit-viscosity.backward-euler={}",
    ] {
        let changed = ran(&scene(&text, &[change]), 1).unwrap_or_else(|e| panic!("{e}"));
        let energy = least(&changed.state(), TURBULENT_ENERGY.name);
        assert!(energy > 0.0, "{change}");
    }
    // 40 kg/m that go with 1 m/s.
    let momentum = runs[0].last("momentum.x");
    assert!((momentum - 40.0).abs() < 1e-9, "{momentum}");
}
