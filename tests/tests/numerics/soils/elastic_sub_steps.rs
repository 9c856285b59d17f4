//! Elastic forces in steps of their own: waves, stiff blocks, slopes, refusals.

use std::f64::consts::TAU;

use sph_core::{System, Vect, fields};
use sph_particles::setup::Assembled;
use sph_tests::{step, within};

use crate::soils::stepping::{NESTED, crest, kinetic_energy, longest, spin_kept, top_at};
use crate::soils::tried;

const SUB_STEPS: &str = "elastic-force.divergence.sub_steps=true";

fn with_sub_steps(scene: &str, overrides: &[&str]) -> Assembled<2> {
    let all: Vec<&str> = [SUB_STEPS].iter().chain(overrides).copied().collect();
    let mut parts = tried(scene, &all).unwrap_or_else(|e| panic!("{e}"));
    parts.flow.evaluate().unwrap();
    parts
}

/// 𝒢 = 10 MPa: a step of sound is three sub-steps, ten of them a period.
#[test]
fn a_standing_wave_keeps_its_frequency_and_its_height() {
    let stiff = ["phase.rubber.rheology.elastic.young_modulus=2.8e7"];
    let mut parts = with_sub_steps("elastic-shear-wave", &stiff);
    let (dt, first) = (longest(&parts), crest(&parts));
    let omega = TAU * (NESTED * 1e7 / 1000.0_f64).sqrt();
    let mut worst = 0.0_f64;
    while omega * parts.flow.world.time < 4.0 * TAU {
        step(&mut parts, dt);
        let exact = (omega * parts.flow.world.time).cos();
        worst = worst.max((crest(&parts) / first - exact).abs());
    }
    println!("dt {dt:e} s, off by {worst:.4} in four periods");
    // Velocities are known half a sub-step beside displacements: a phase of ωΔt/2.
    let phase = 0.5 * omega * dt / 3.0;
    assert!(worst < phase, "{worst}, measured 0.0965");
}

/// 𝒢 = 1 GPa, 30 sub-steps: shaken at random and undamped, a block neither gains energy nor comes to rest.
#[test]
fn a_stiff_block_that_is_shaken_gains_nothing() {
    let shaken = ["phase.rubber.rheology.elastic.young_modulus=2.8e9 \
         phase.rubber.rheology.elastic.viscosity=0 numerics.jitter=0.2 \
         numerics.velocity_noise=0.01"];
    let mut parts = with_sub_steps("elastic-shear-wave", &shaken);
    let limits = parts.flow.step_limits().unwrap();
    assert!(limits.iter().all(|l| l.name != "elastic wave"));
    let (dt, first) = (longest(&parts), kinetic_energy(&parts));
    let mut most = 0.0_f64;
    for _ in 0..300 {
        step(&mut parts, dt);
        most = most.max(kinetic_energy(&parts));
    }
    let last = kinetic_energy(&parts);
    println!("{first:e} J, then {most:e} at most, {last:e} at the end, dt {dt:e} s");
    assert!(most < 1.05 * first, "{most} J of {first}");
    assert!(last > 0.1 * first, "{last} J of {first}");
}

/// With steps that elastic waves would allow there is one sub-step, and the scheme is that without.
#[test]
fn one_sub_step_is_the_step_itself() {
    let mut with = with_sub_steps("elastic-shear-wave", &[]);
    let undamped = ["elastic-force.divergence.hourglass=0"];
    let mut without = tried("elastic-shear-wave", &undamped).unwrap_or_else(|e| panic!("{e}"));
    without.flow.evaluate().unwrap();
    let dt = 0.5 * longest(&without);
    for _ in 0..100 {
        step(&mut with, dt);
        step(&mut without, dt);
    }
    let velocities = |parts: &Assembled<2>| {
        let all = parts.flow.world.free.get(fields::VELOCITY).unwrap();
        all.to_vec()
    };
    let both = velocities(&with).into_iter().zip(velocities(&without));
    let apart = both.map(|(a, b): (Vect<2>, Vect<2>)| (a - b).norm());
    let apart = apart.fold(0.0, f64::max);
    println!("{apart:e} m/s apart");
    assert!(apart < 1e-12, "{apart} m/s apart");
}

/// E = 1 GPa, 19 sub-steps. The layer that should stand creeps with 2.1 mm/s; one 3° steeper has 0.290 m/s after 0.5 s (0.297 if it
/// flowed at once; 0.263 without sub-steps, 0.158 with stresses of the end of the step).
#[test]
fn stiff_slopes_stand_and_flow_as_without() {
    let stiff = "phase.sand.rheology.drucker-prager.young_modulus=1e9";
    let mut parts = with_sub_steps("resting-slope", &[stiff]);
    let resting = top_at(&mut parts, 0.2);
    let steep = ["numerics.gravity=[0,-8.227]", "numerics.driving=[5.343,0]"];
    let mut parts = with_sub_steps("resting-slope", &[stiff, steep[0], steep[1]]);
    let half = top_at(&mut parts, 0.5);
    println!("{resting:e} m/s at rest, {half} m/s after 0.5 s");
    assert!(resting.abs() < 5e-3, "{resting} m/s where it should stand");
    within(half, 0.263..0.297, "m/s after 0.5 s");
}

#[test]
fn a_disc_that_spins_freely_keeps_its_angular_momentum() {
    let kept = spin_kept("[elastic-force.divergence]\nsub_steps = true\n");
    println!("angular momentum after 1 rad: {kept}");
    assert!((kept - 1.0).abs() < 1e-5, "{kept} of it");
}
