//! The elastic force of displacements, and forces that are blended: against closed forms, momentum, refusals.

use std::f64::consts::TAU;

use sph_core::{Registry, Role, System, Vect, fields};
use sph_multiphase::viscosity::{Viscosity, ViscousOperatorEntry};
use sph_neighbours::{Interaction, interactions};
use sph_particles::setup::Assembled;
use sph_rheology::{DruckerPrager, Newtonian, Rheology};
use sph_soil::stress::{Blended, Rheologies};
use sph_tests::{DAM_BREAK, Says, assembled, changes, close, momentum, move_as, scene, within};

use crate::soils::tried;

/// ρ and 𝒢 of `elastic-shear-wave`, kg/m³ and Pa.
const DENSITY: f64 = 1000.0;
const MODULUS: f64 = 1e5;

/// The periodic elastic block at rest, 0.5 m × 1 m, with a displacement of every particle; evaluated.
fn displaced(overrides: &[&str], of: impl Fn(usize, &Vect<2>) -> Vect<2>) -> Assembled<2> {
    let base = ["elastic-force.displacement={}"];
    let all: Vec<&str> = base.iter().chain(overrides).copied().collect();
    let mut parts = tried("elastic-shear-wave", &all).unwrap_or_else(|e| panic!("{e}"));
    let free = &mut parts.flow.world.free;
    free.get_mut(fields::VELOCITY).unwrap().fill(Vect::zeros());
    let places = free.get(fields::POSITION).unwrap().to_vec();
    let ways = free.get_mut(fields::ELASTIC_DISPLACEMENT).unwrap();
    for (k, (way, place)) in ways.iter_mut().zip(&places).enumerate() {
        *way = of(k, place);
    }
    parts.flow.evaluate().unwrap();
    parts
}

/// Root mean square error of the acceleration of X = (A sin ky, 0), which is −𝒢k²X/ρ, over that of the exact one.
fn wave_error(spacing: &str, lattice: &str) -> f64 {
    let lattice = format!("elastic-force.displacement.on_lattice={lattice}");
    let way = |x: &Vect<2>| Vect::from([1e-6 * (TAU * x[1]).sin(), 0.0]);
    let parts = displaced(&[spacing, &lattice], |_, x| way(x));
    let free = &parts.flow.world.free;
    let all = free.get(fields::ACCELERATION).unwrap().iter();
    let (mut error, mut size) = (0.0, 0.0);
    for (a, x) in all.zip(free.get(fields::POSITION).unwrap()) {
        let exact = way(x) * (-MODULUS * TAU * TAU / DENSITY);
        error += (a - exact).norm_squared();
        size += exact.norm_squared();
    }
    (error / size).sqrt()
}

#[test]
fn the_force_of_a_wave_converges_with_the_second_order() {
    let spacings = ["0.05", "0.025", "0.0125"].map(|s| format!("numerics.spacing={s}"));
    let errors = [0, 1, 2].map(|k| wave_error(&spacings[k], "exact"));
    let order = (errors[1] / errors[2]).log2();
    // The first term that a second difference neglects is k²σ²/4 with σ² = (5/18) h² of Wendland C2; 40 rows, h = 2 δr.
    let neglected = (TAU * 2.0 / 40.0).powi(2) * (5.0 / 18.0) / 4.0;
    assert!(errors[1] < neglected, "{errors:?}, measured 5.8e-3");
    close(order, 2.0, 0.05, "order");
    // As printed the sum is 2 % too small on a lattice with h = 2 δr, whatever the spacing.
    let literal = wave_error(&spacings[2], "literal");
    println!("exact {errors:?}, literal {literal}");
    within(literal, 0.019..0.023, "error, measured 0.0222");
}

const CUBE: &str = include_str!("cube.toml");

#[test]
fn in_space_it_is_the_same_force() {
    let mut parts = assembled::<3>(&scene(CUBE, &[]));
    let free = &mut parts.flow.world.free;
    let places = free.get(fields::POSITION).unwrap().to_vec();
    let way = |x: &Vect<3>| Vect::from([0.0, 0.0, 1e-6 * (TAU * x[1]).sin()]);
    let ways = free.get_mut(fields::ELASTIC_DISPLACEMENT).unwrap();
    ways.iter_mut().zip(&places).for_each(|(w, x)| *w = way(x));
    parts.flow.evaluate().unwrap();
    let free = &parts.flow.world.free;
    let all = free.get(fields::ACCELERATION).unwrap().iter().zip(&places);
    let factor = MODULUS * TAU * TAU / DENSITY;
    let error = all.fold(0.0_f64, |most, (a, x)| {
        most.max((a + way(x) * factor).norm())
    });
    let error = error / (factor * 1e-6);
    println!("3D, 20 rows: {error}");
    // k²σ²/4 with σ² = (4/15) h² in space; 20 rows, h = 1.5 δr.
    let neglected = (TAU * 1.5 / 20.0).powi(2) * (4.0 / 15.0) / 4.0;
    assert!(error < neglected, "{error}, measured 0.0133");
}

#[test]
fn a_rigid_translation_makes_no_force() {
    let parts = displaced(&["numerics.jitter=0.2"], |_, _| Vect::from([0.3, -0.2]));
    let force = |parts: &Assembled<2>| {
        let all = parts.flow.world.free.get(fields::ACCELERATION).unwrap();
        all.to_vec()
    };
    // What is left is the pressure on a shaken lattice.
    let still = displaced(&["numerics.jitter=0.2"], |_, _| Vect::zeros());
    assert_eq!(force(&parts), force(&still));
}

/// A number in ±½ that looks random.
fn noise(k: usize) -> f64 {
    let mixed = (k as u64 + 1).wrapping_mul(0x9E37_79B9_7F4A_7C15);
    ((mixed ^ (mixed >> 29)).wrapping_mul(0xBF58_476D_1CE4_E5B9) >> 11) as f64 / 2f64.powi(53) - 0.5
}

#[test]
fn second_differences_leave_the_momentum_in_a_closed_box() {
    let any = |k: usize, _: &Vect<2>| Vect::from([noise(2 * k), noise(2 * k + 1)]) * 1e-3;
    let parts = displaced(&["numerics.jitter=0.2"], any);
    let free = &parts.flow.world.free;
    let mass = free.get(fields::MASS).unwrap();
    let all = mass.iter().zip(free.get(fields::ACCELERATION).unwrap());
    let (mut sum, mut size) = (Vect::<2>::zeros(), 0.0);
    for (m, a) in all {
        sum += a * *m;
        size += a.norm() * m;
    }
    let share = sum.norm() / size;
    assert!(share < 1e-13, "{share:e} of all forces is left");
}

/// A disc that flies with `speed` (m/s) into a block of the same material, for some steps.
fn struck(overrides: &[&str], speed: f64, steps: usize) -> f64 {
    let mut parts = tried("elastic-shear-wave", overrides).unwrap_or_else(|e| panic!("{e}"));
    move_as(&mut parts, |x| {
        let flies = (x - Vect::from([0.25, 0.4])).norm() < 0.15;
        Vect::from([speed, 0.5 * speed]) * f64::from(u8::from(flies))
    });
    let (before, _) = momentum(&parts);
    for _ in 0..steps {
        parts.flow.evaluate().unwrap();
        let limits = parts.flow.limits();
        let dt = 0.9 * sph_core::StepLimit::least(&limits).unwrap().dt;
        parts.flow.world.dt = dt;
        parts.integrator.step(&mut parts.flow, dt).unwrap();
    }
    (momentum(&parts).0 - before).norm() / before.norm()
}

/// Yields at 500 Pa, whatever the pressure.
const CLAY: &str = "phase.rubber.rheology.drucker-prager={young_modulus=2.8e5, poisson_ratio=0.4, \
                    friction_angle=0, cohesion=500, grain_diameter=5e-3, grain_density=2650}";

#[test]
fn momentum_of_each_force_form() {
    let turned = "elastic-force.displacement={}";
    let forces = "elastic-force.divergence.blend=forces";
    let both = "elastic-force.displacement.blend=forces";
    let rubber = [struck(&[], 1.0, 200), struck(&[turned], 1.0, 200)];
    let clay = [&[CLAY][..], &[CLAY, forces], &[CLAY, turned], &[CLAY, both]];
    let clay = clay.map(|overrides| struck(overrides, 1.0, 200));
    let told = format!("rubber {rubber:?}, clay {clay:?} of the momentum lost");
    println!("{told}");
    // Pairs of stresses.
    assert!(rubber[0] < 1e-13 && clay[0] < 1e-13, "{told}");
    // D{J} is of the second order in the strain; shares of forces are not small.
    within(rubber[1], 1e-6..1e-4, "share, measured 1.3e-5");
    assert!((0.05..0.3).contains(&clay[1]), "{told}, 0.14 was measured");
    assert!(clay[2].min(clay[3]) > 0.5, "{told}, measured 0.78");
}

/// Where the soil is solid only the water rubs it, and with it the water has what it gives: Σ m a = 0.
#[test]
fn friction_of_water_on_a_soil_stays_out_of_the_blend() {
    let mut parts = tried("saturated-bed-at-rest", &[]).unwrap_or_else(|e| panic!("{e}"));
    parts.flow.evaluate().unwrap();
    let world = &mut parts.flow.world;
    (world.gravity, world.driving) = (Vect::zeros(), Vect::zeros());
    let phase = world.free.get(fields::PHASE).unwrap().to_vec();
    let velocities = world.free.get_mut(fields::VELOCITY).unwrap();
    for (k, u) in velocities.iter_mut().enumerate() {
        *u = Vect::from([noise(2 * k), noise(2 * k + 1)]);
    }
    world.free.add(fields::FRICTION_SHARE, Role::Derived);
    let shares = world.free.get_mut(fields::FRICTION_SHARE).unwrap();
    let solid = |phase: &u32| f64::from(*phase);
    shares
        .iter_mut()
        .zip(&phase)
        .for_each(|(s, p)| *s = solid(p));
    // Phases in the order of their names: sand, water.
    let sand = "young_modulus=8e5\npoisson_ratio=0.3\nfriction_angle=0.5\ngrain_diameter=4e-3\n\
                grain_density=2650";
    let sand: DruckerPrager = toml::from_str(sand).unwrap();
    let water = Newtonian { viscosity: 1e-3 };
    let laws: Rheologies = vec![Box::new(sand) as Box<dyn Rheology>, Box::new(water)].into();
    let registry = Registry::<ViscousOperatorEntry>::discovered().unwrap();
    let entry = registry.find("monaghan-gingold").unwrap();
    let operator = entry.build::<2>(&toml::Table::new()).unwrap();
    let left = |term: Box<dyn Interaction<2>>| {
        let mut acceleration = vec![Vect::<2>::zeros(); phase.len()];
        interactions(world, &[term], &mut acceleration, None).unwrap();
        let mass = world.free.get(fields::MASS).unwrap();
        let all = acceleration.iter().zip(mass);
        let (mut sum, mut size) = (Vect::<2>::zeros(), 0.0);
        for (a, m) in all {
            sum += a * *m;
            size += a.norm() * m;
        }
        sum.norm() / size
    };
    let apart = left(Box::new(Blended::friction(
        operator.term(Viscosity::PerPhase),
        &laws,
    )));
    let within = left(Box::new(Blended {
        apart: Vec::new(),
        ..Blended::friction(operator.term(Viscosity::PerPhase), &laws)
    }));
    println!("left of all forces: {apart:e}, with all friction in the blend {within:e}");
    assert!(apart < 1e-13 && within > 1e-3, "{apart:e} {within:e}");
}

#[test]
fn unknown_names_are_told_with_the_nearest_one() {
    for (set, words) in [
        ("displacment={}", "displacment | `displacement`"),
        ("displacement.blend=force", "force | forces"),
        ("displacement.blnd=forces", "blnd | blend"),
    ] {
        let set = changes(&[&format!("elastic-force.{set}")]);
        let refused = sph_scene::parse(DAM_BREAK, "scene.toml", &set);
        refused.expect_err("a mistake").to_string().says(words);
    }
}

#[test]
fn a_scene_that_does_not_ask_carries_nothing_of_it() {
    let columns = |overrides: &[&str]| {
        let parts = tried("infinite-slope", overrides).unwrap_or_else(|e| panic!("{e}"));
        let all = parts.flow.world.free.columns();
        all.map(|(name, ..)| name).collect::<Vec<_>>()
    };
    let undamped = "elastic-force.divergence.hourglass=0";
    let [plain, asked] = [undamped, "elastic-force.displacement={}"].map(|o| columns(&[o]));
    for name in [
        "elastic_displacement",
        "stress_rotation",
        "solid_fraction",
        "yield_factor",
    ] {
        assert!(!plain.contains(&name) && asked.contains(&name), "{name}");
    }
}
