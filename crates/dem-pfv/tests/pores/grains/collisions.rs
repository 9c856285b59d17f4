//! Two spheres, or a sphere and a wall, hit each other.

use std::f64::consts::PI;

use dem_pfv::grains::{ContactLaw, Grain, GrainSystem, HertzMindlin, Setup};

use crate::close;
use crate::grains::{RADIUS, STIFFNESS, floor, grain, kilogram, law, run, spin, velocity};

/// Time from the first touch to the opening, found between steps, and the speed ratio of a head-on collision.
fn head_on(law: impl ContactLaw + 'static, speed: f64, step: f64) -> (f64, f64) {
    let grains = vec![
        grain(-RADIUS, 0.0, 0.0).moving([0.5 * speed, 0.0, 0.0]),
        grain(RADIUS, 0.0, 0.0).moving([-0.5 * speed, 0.0, 0.0]),
    ];
    let mut system = GrainSystem::new(Setup::new(grains, law)).expect("a pair");
    let gap = |s: &GrainSystem| {
        let x = &s.grains.position;
        x[1].x - x[0].x - 2.0 * RADIUS
    };
    let mut before = 0.0;
    loop {
        system.step(step).expect("a step");
        let now = gap(&system);
        if now > 0.0 {
            let opened = system.time - step * now / (now - before);
            let apart = velocity(&system, 1).x - velocity(&system, 0).x;
            return (opened, apart / speed);
        }
        before = now;
    }
}

#[test]
fn linear_collision_lasts_half_a_period() {
    let omega = (STIFFNESS / 0.5).sqrt(); // m* = 0.5 kg
    let step = PI / omega / 1000.0;
    let (time, restitution) = head_on(law(0.5, 0.3, 0.0), 0.1, step);
    // The scheme is of second order in ω Δt.
    let error = (omega * step).powi(2);
    close(time * omega / PI, 1.0, error);
    close(restitution, 1.0, error);
}

/// The dashpot sees the velocity half a step late and misses parts of the first and last step: first order in ω Δt.
#[test]
fn linear_restitution_is_that_of_a_damped_oscillator() {
    let omega = (STIFFNESS / 0.5).sqrt();
    for zeta in [0.05_f64, 0.2, 0.5] {
        let step = PI / omega / 10_000.0;
        let (_, restitution) = head_on(law(0.5, 0.3, zeta), 0.1, step);
        let expected = (-PI * zeta / (1.0 - zeta * zeta).sqrt()).exp();
        close(restitution, expected, 4.0 * zeta * omega * step);
    }
}

const HERTZ: f64 = 1e7;

fn hertz(damping: f64) -> HertzMindlin {
    HertzMindlin {
        damping,
        ..HertzMindlin::new(HERTZ, 0.3, 0.3)
    }
}

/// 2.868 266 (m*² / (R* E*² v))^(1/5). Source: Hertz 1882; Johnson 1985, Eq. (11.24).
fn hertz_time(speed: f64) -> f64 {
    let modulus = hertz(0.0).contact_modulus();
    let (mass, radius): (f64, f64) = (0.5, 0.5 * RADIUS);
    2.868_266 * (mass.powi(2) / (radius * modulus.powi(2) * speed)).powf(0.2)
}

#[test]
fn hertz_collision_lasts_as_long_as_it_should() {
    for speed in [0.01, 0.1, 1.0] {
        let expected = hertz_time(speed);
        let (time, restitution) = head_on(hertz(0.0), speed, expected / 2000.0);
        close(time / expected, 1.0, 1e-5);
        close(restitution, 1.0, 1e-5);
    }
}

/// The same restitution at any speed. Source: Antypov & Elliott 2011.
#[test]
fn hertz_restitution_does_not_depend_on_speed() {
    let zeta: f64 = 0.2;
    let expected = (-PI * zeta / (1.0 - zeta * zeta).sqrt()).exp();
    for speed in [0.01, 1.0] {
        let step = hertz_time(speed) / 20_000.0;
        let (_, restitution) = head_on(hertz(zeta), speed, step);
        close(restitution, expected, 4.0 * zeta * PI / 20_000.0);
    }
}

/// Equal spheres exchange their velocities; the loose way to read Newton's cradle.
#[test]
fn unequal_spheres_keep_momentum_and_energy() {
    let small = Grain::new([0.15, 0.0, 0.0], 0.05, kilogram());
    let grains = vec![grain(0.0, 0.0, 0.0).moving([0.1, 0.0, 0.0]), small];
    let mut system = GrainSystem::new(Setup::new(grains, law(0.5, 0.0, 0.0))).expect("pair");
    let step = 1e-3 * system.critical_step();
    run(&mut system, step, 20_000);
    let (m1, m2) = (system.grains.mass[0], system.grains.mass[1]);
    close(velocity(&system, 0).x, 0.1 * (m1 - m2) / (m1 + m2), 1e-7);
    close(velocity(&system, 1).x, 0.2 * m1 / (m1 + m2), 1e-7);
}

/// A sphere hits a wall with equal normal and tangential parts, and so deep as δ.
fn oblique(ratio: f64, friction: f64, normal: f64, tangential: f64) -> GrainSystem {
    let ball = grain(0.0, 0.0, RADIUS).moving([tangential, 0.0, -normal]);
    let setup = Setup::new(vec![ball], law(ratio, friction, 0.0)).walls([floor()]);
    let mut system = GrainSystem::new(setup).expect("a ball");
    let step = 1e-3 / STIFFNESS.sqrt();
    run(&mut system, step, 3500); // longer than π
    system
}

/// It slides all the time: the tangential impulse is µ times the normal one, 2 m v_n, and turns it by 5/2 of that.
#[test]
fn flat_impacts_slide() {
    let (vn, vt, mu) = (0.01, 0.1, 0.3);
    let system = oblique(0.5, mu, vn, vt);
    let up = velocity(&system, 0).z;
    close(velocity(&system, 0).x, vt - mu * (vn + up), 1e-12);
    let depth = vn / STIFFNESS.sqrt() / RADIUS;
    let turned = 2.5 * mu * (vn + up) / RADIUS;
    close(spin(&system, 0).y, turned, depth * turned);
}

/// With k_t = 2/7 k_n both springs swing in time, and the velocity of the contact point is reversed.
#[test]
fn steep_impacts_stick() {
    let (vn, vt) = (0.01, 0.01);
    let system = oblique(2.0 / 7.0, 1.0, vn, vt);
    let depth = vn / STIFFNESS.sqrt() / RADIUS;
    close(velocity(&system, 0).x, 3.0 / 7.0 * vt, depth * vt);
    let turned = 10.0 / 7.0 * vt / RADIUS;
    close(spin(&system, 0).y, turned, depth * turned);
}
