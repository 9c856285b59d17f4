//! Strain rates that come along with the interactions, and stresses that are not along them.

use std::f64::consts::TAU;

use nalgebra::Matrix2;
use sph_core::{System, Vect, fields};
use sph_neighbours::World;
use sph_probes::Probe;
use sph_tests::{PERIODIC, below, move_as};
use sph_turbulence::{AlgebraicStress, LAST_STRAIN, TurbulentEnergyProbe};

use crate::turbulence::{CHANNEL, assembled};

const K_EPSILON: &str = "[eddy-viscosity.k-epsilon]\nenergy = 1e-2\ndissipation = 1e-2\n";

/// Waves over a bed that rubs by its wall function alone.
fn waves(x: &Vect<2>) -> Vect<2> {
    let [along, up] = [TAU * x.x / 0.2, TAU * x.y / 0.2];
    Vect::from([1.0 + along.sin() * up.cos(), 0.5 * along.cos() * up.sin()])
}

fn evaluated(text: &str, changes: &[&str], velocity: fn(&Vect<2>) -> Vect<2>) -> World<2> {
    let mut parts = assembled::<2>(text, changes);
    move_as(&mut parts, velocity);
    parts.flow.evaluate().expect("an evaluation");
    parts.flow.world
}

/// The gradient has its own walk where an output shows it, and none where it comes with the interactions.
#[test]
fn strain_rates_that_ride_along_are_those_of_a_walk_of_their_own() {
    let text = format!("{CHANNEL}{K_EPSILON}");
    let riding = evaluated(&text, &[], waves);
    let shown = ["output.fields=[\"strain_rate\"]"];
    let own = evaluated(&text, &shown, waves);
    assert!(own.free.has(fields::VELOCITY_GRADIENT.name));
    assert!(!riding.free.has(fields::VELOCITY_GRADIENT.name));
    let [a, b] = [&riding, &own].map(|w| w.free.get(fields::STRAIN_RATE).expect("rates"));
    let largest = a.iter().copied().fold(0.0, f64::max);
    assert!(largest > 10.0, "{largest}");
    for (a, b) in a.iter().zip(b) {
        // Sums of the same numbers.
        assert!((a - b).abs() <= 1e-12 * largest, "{a} and {b} of {largest}");
    }
    let [a, b] = [&riding, &own].map(|w| w.free.get(fields::ACCELERATION).expect("a"));
    assert_eq!(a, b);
}

/// Where k and ε are the same everywhere their means are these, and the whole is the mass times k.
#[test]
fn the_energy_of_even_eddies_is_the_mass_times_theirs() {
    let world = evaluated(&format!("{CHANNEL}{K_EPSILON}"), &[], waves);
    let told = TurbulentEnergyProbe {}.measure(&world).expect("numbers");
    let mass: f64 = world.free.get(fields::MASS).expect("m").iter().sum();
    for (told, exact) in told.into_iter().zip([mass * 1e-2, 1e-2, 1e-2, 1e-2]) {
        assert!((told / exact - 1.0).abs() < 1e-12, "{told}, {exact}");
    }
}

#[test]
fn smagorinskys_eddies_follow_the_strain_of_the_last_step() {
    let text = format!("{CHANNEL}[eddy-viscosity.smagorinsky]\nstrain_of = \"last-step\"\n");
    let mut parts = assembled::<2>(&text, &[]);
    move_as(&mut parts, waves);
    parts.flow.evaluate().expect("an evaluation");
    let of = |world: &World<2>, field| world.free.get(field).expect("a column").to_vec();
    let first = of(&parts.flow.world, fields::STRAIN_RATE);
    let none = of(&parts.flow.world, fields::EDDY_VISCOSITY);
    assert!(none.iter().all(|e| *e == 0.0));
    let step = parts.integrator.step(&mut parts.flow, 1e-5);
    step.expect("a step");
    let world = &parts.flow.world;
    assert_eq!(of(world, LAST_STRAIN), first);
    parts.flow.evaluate().expect("an evaluation");
    let world = &parts.flow.world;
    let width = 0.1 * 2.0 * world.kernel.smoothing_length();
    let [eddies, density] = [fields::EDDY_VISCOSITY, fields::DENSITY].map(|f| of(world, f));
    let strains = of(world, LAST_STRAIN);
    for ((eddy, rho), strain) in eddies.iter().zip(density).zip(strains) {
        let exact = rho * width * width * strain;
        assert!((eddy - exact).abs() <= 1e-12 * exact, "{eddy}, {exact}");
    }
}

const RATE: f64 = 1.0;

/// Layers u = (U sin 2πy, 0), whose normal stresses τ_yy = −ρk a_yy push across them: a_y = −k da_yy/dy.
#[test]
fn normal_stresses_of_eddies_push_across_layers() {
    let layers: fn(&Vect<2>) -> Vect<2> = |x| Vect::from([RATE / TAU * (TAU * x.y).sin(), 0.0]);
    let (k, time) = (0.5, 0.2);
    let closure = |variant: &str| {
        format!(
            "[eddy-viscosity.k-epsilon]\nenergy = {k}\ndissipation = {}\nvariant = \"{variant}\"\n",
            k / time
        )
    };
    let accelerations = |variant: &str| {
        let world = evaluated(
            &format!("{PERIODIC}\n{}", closure(variant)),
            &["numerics.spacing=0.025"],
            layers,
        );
        let mass = world.free.get(fields::MASS).expect("masses").to_vec();
        let places = world.free.get(fields::POSITION).expect("places").to_vec();
        let all = world.free.get(fields::ACCELERATION).expect("a").to_vec();
        (mass, places, all, world.kernel.smoothing_length())
    };
    let (mass, places, with, h) = accelerations("explicit-algebraic");
    let (_, _, without, _) = accelerations("standard");
    let normal = |y: f64| {
        let gradient = Matrix2::new(0.0, RATE * (TAU * y).cos(), 0.0, 0.0);
        AlgebraicStress::anisotropy(&gradient, time).across[(1, 1)]
    };
    let push = |y: f64| -k * (normal(y + 1e-5) - normal(y - 1e-5)) / 2e-5;
    let largest = (0..100).map(|n| push(n as f64 / 100.0)).fold(0.0, f64::max);
    assert!(largest > 0.0);
    let (mut worst, mut total) = (0.0f64, Vect::<2>::zeros());
    for i in 0..places.len() {
        // Along y the rest is the same: nothing moves across layers.
        let found = with[i].y - without[i].y;
        worst = worst.max((found - push(places[i].y)).abs());
        total += with[i] * mass[i];
    }
    // A first difference has a mean over the kernel in it, which takes M_2 κ²h²/4 of a wave κ, M_2 = 5/9 of Wendland's C²:
    // once for κ = 2π of the velocity, which counts twice in the stress, once for κ = 4π of the stress; and as much again
    // for its higher waves.
    let bound = 2.0 * (2.0 + 4.0) * (5.0 / 9.0) * (TAU * h).powi(2) / 4.0;
    below(worst, bound * largest, "m/s² off");
    let scale = mass.iter().sum::<f64>() * largest;
    assert!(total.norm() < 1e-10 * scale, "{total} of {scale}");
}
