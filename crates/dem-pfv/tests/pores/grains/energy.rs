//! What is conserved.

use dem_pfv::grains::{GrainSystem, HertzMindlin, Partner, Setup, Vector};

use crate::close;
use crate::grains::{RADIUS, STIFFNESS, floor, grain, jaws, law, position, run, velocity};

/// A ball pressed between two walls is a linear oscillator, for which the leap-frog conserves
/// ½ m v₋ v₊ + ½ k x² to rounding.
#[test]
fn a_pressed_ball_keeps_its_energy_for_a_hundred_thousand_steps() {
    let ball = grain(0.0, 0.0, 0.01 * RADIUS);
    let setup = Setup::new(vec![ball], law(0.0, 0.0, 0.0)).walls(jaws());
    let mut system = GrainSystem::new(setup).expect("ball");
    let step = 0.3 * system.critical_step();
    let energy = |system: &mut GrainSystem| {
        let (x, before) = (position(system, 0).z, velocity(system, 0).z);
        system.step(step).expect("a step");
        0.5 * before * velocity(system, 0).z + 0.5 * 2.0 * STIFFNESS * x * x
    };
    let first = energy(&mut system);
    for _ in 0..100 {
        run(&mut system, step, 999);
        let now = energy(&mut system);
        // Rounding of positions near 0.1 m, a walk of 10⁵ steps.
        close(now / first, 1.0, 1e-10);
    }
}

/// Two spheres that stick and roll about each other while they bounce: shear springs give back what they took.
#[test]
fn a_pair_that_sticks_gives_back_its_energy() {
    let shift = 0.4 * RADIUS;
    let grains = vec![
        grain(-RADIUS, shift, 0.0).moving([0.05, 0.0, 0.0]),
        grain(RADIUS, -shift, 0.0).moving([-0.05, 0.0, 0.0]),
    ];
    let setup = Setup::new(grains, law(2.0 / 7.0, 10.0, 0.0));
    let mut system = GrainSystem::new(setup).expect("pair");
    let before = system.kinetic_energy();
    let step = 1e-2 * system.critical_step();
    run(&mut system, step, 40_000);
    assert!(velocity(&system, 0).x < 0.0, "they parted");
    // k_t = 2/7 k_n: the shear spring is empty when the contact opens. The normal turns by v T / R meanwhile.
    let turn = 0.1 * std::f64::consts::PI * (0.5 / STIFFNESS).sqrt() / RADIUS;
    close(system.kinetic_energy() / before, 1.0, turn * turn);
}

/// Bouncing under gravity for 10⁵ steps: ½ m v² + m g z returns to its value after each flight.
#[test]
fn a_bouncing_ball_neither_rises_nor_sinks() {
    let height = 3.0 * RADIUS;
    let ball = vec![grain(0.0, 0.0, height)];
    let setup = Setup::new(ball, HertzMindlin::new(1e6, 0.3, 0.5)).walls([floor()]);
    let mut system = GrainSystem::new(setup.gravity([0.0, 0.0, -9.81])).expect("a ball");
    let step = 1e-5;
    let (mut highest, mut bounces) = (0.0_f64, 0);
    let mut last = 0.0;
    for _ in 0..100_000 {
        system.step(step).expect("a step");
        let now = velocity(&system, 0).z;
        if last > 0.0 && now <= 0.0 {
            highest = position(&system, 0).z;
            bounces += 1;
        }
        last = now;
    }
    assert!(bounces >= 2);
    // Each impact adds an error of second order in ω Δt of either sign, ω the frequency of the contact.
    let omega = (STIFFNESS * 10.0_f64).sqrt();
    let error = f64::from(bounces) * (omega * step).powi(2);
    close(highest / height, 1.0, error);
}

/// A cloud without walls, with friction, dashpots and rolling: forces and moments cancel exactly.
#[test]
fn a_free_cloud_keeps_its_momentum_and_angular_momentum() {
    let mut grains = Vec::new();
    for i in 0..64 {
        let at = |k: i32| f64::from(i / k % 4) * 2.05 * RADIUS;
        let (x, y, z) = (at(1), at(4), at(16));
        // It falls together and turns.
        let mut ball = grain(x, y, z).moving([0.6 - y - x, -y + x, 0.3 - z]);
        ball.spin = [1.0, f64::from(i % 3), -1.0].into();
        grains.push(ball);
    }
    let mut system = GrainSystem::new(Setup::new(grains, law(0.5, 0.4, 0.1))).expect("cloud");
    let momenta = |s: &GrainSystem| {
        let g = &s.grains;
        let (mut p, mut l, mut scale) = (Vector::zeros(), Vector::zeros(), 0.0);
        for i in 0..g.len() {
            let one = g.velocity[i] * g.mass[i];
            p += one;
            l += g.position[i].cross(&one) + g.spin[i] * g.inertia(i);
            scale += one.norm();
        }
        (p, l, scale)
    };
    let (p, l, scale) = momenta(&system);
    let step = 0.3 * system.critical_step();
    let mut touched = 0;
    for _ in 0..2000 {
        system.step(step).expect("a step");
        let contacts = system.contacts();
        touched += contacts
            .filter(|c| matches!(c.partner, Partner::Grain(_)))
            .count();
    }
    assert!(touched > 1000);
    let (p2, l2, _) = momenta(&system);
    let rounding = 2000.0 * f64::EPSILON * scale;
    assert!((p2 - p).norm() < rounding, "{}", p2 - p);
    assert!((l2 - l).norm() < rounding, "{}", l2 - l);
}
