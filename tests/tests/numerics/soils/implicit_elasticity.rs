//! Elastic stresses of the end of the step: the wave of the scheme, stiff blocks, soils that rest, refusals.

use std::f64::consts::TAU;

use sph_core::{System, Vect, fields};
use sph_particles::setup::Assembled;
use sph_tests::{close, step};

use crate::soils::stepping::{NESTED, crest, kinetic_energy, longest, spin_kept, top_at};
use crate::soils::tried;

const IMPLICIT: [&str; 3] = [
    "elastic-force.divergence.implicit=true",
    "implicit-viscosity.backward-euler={}",
    "viscous-operator={monaghan-gingold={within='arithmetic'}}",
];

fn with_implicit(scene: &str, overrides: &[&str]) -> Assembled<2> {
    let all: Vec<&str> = IMPLICIT.iter().chain(overrides).copied().collect();
    tried(scene, &all).unwrap_or_else(|e| panic!("{e}"))
}

/// u' = (u + σ)/(1 + a), σ' = σ − b u' with a = 𝒢Δt²k²/ρ of the second differences and b of the nested ones.
#[test]
fn a_standing_wave_is_that_of_the_scheme() {
    for (a, steps) in [(0.03, 40), (1.0, 10), (100.0, 3)] {
        let mut parts = with_implicit("elastic-shear-wave", &[]);
        parts.flow.evaluate().unwrap();
        let dt = (a / (1e5_f64 * TAU * TAU / 1000.0)).sqrt();
        let (first, mut u, mut stress) = (crest(&parts), 1.0, 0.0);
        let mut worst = 0.0_f64;
        for _ in 0..steps {
            step(&mut parts, dt);
            u = (u + stress) / (1.0 + a);
            stress -= NESTED * a * u;
            worst = worst.max((crest(&parts) / first - u).abs());
        }
        println!("a = {a}: off by {worst:.4} after {steps} steps, exact {u:.4}");
        assert!(worst < 0.005, "a = {a}: {worst}, measured 0.0021");
    }
}

/// 𝒢 = 1 GPa: the step of sound is 60 times that of elastic waves. Shaken at random, a block comes to rest but for what
/// moves all of it.
fn rings_out(integrator: &str) {
    let chosen = format!("integrator={{{integrator}={{}}}}");
    let shaken = [
        "phase.rubber.rheology.elastic.young_modulus=2.8e9",
        "numerics.jitter=0.2",
        "numerics.velocity_noise=0.01",
        &chosen,
    ];
    let mut parts = with_implicit("elastic-shear-wave", &shaken);
    parts.flow.evaluate().unwrap();
    let limits = parts.flow.step_limits().unwrap();
    assert!(limits.iter().all(|l| l.name != "elastic wave"));
    let dt = limits.iter().map(|l| l.dt).fold(f64::INFINITY, f64::min);
    let first = kinetic_energy(&parts);
    let mut most = 0.0_f64;
    for _ in 0..300 {
        step(&mut parts, dt);
        most = most.max(kinetic_energy(&parts));
    }
    let last = kinetic_energy(&parts);
    println!("{integrator}: {first:e} J, then {most:e} at most, {last:e} at the end, dt {dt:e}");
    assert!(most < first, "{integrator}: {most} J of {first}");
    assert!(last < 1e-6 * first, "{integrator}: {last} J of {first}");
}

#[test]
fn a_stiff_block_rings_out_with_the_step_of_sound_and_any_integrator() {
    for integrator in [
        "symplectic-euler",
        "verlet",
        "leap-frog",
        "predictor-corrector",
    ] {
        rings_out(integrator);
    }
}

/// What is solved for acts along the lines between particles: nothing brakes a disc that nothing holds.
#[test]
fn a_disc_that_spins_freely_keeps_its_angular_momentum() {
    let ahead =
        "[elastic-force.divergence]\nimplicit = true\n[implicit-viscosity.backward-euler]\n";
    let kept = spin_kept(ahead);
    println!("angular momentum after 1 rad: {kept}");
    assert!((kept - 1.0).abs() < 1e-5, "{kept} of it");
}

/// Friction 3° below what stands, E = 1 GPa, in steps of sound: 2·10⁻⁷ m/s after 0.1 s.
#[test]
fn a_stiff_slope_stands() {
    let stiff = ["phase.sand.rheology.drucker-prager.young_modulus=1e9"];
    let mut parts = with_implicit("resting-slope", &stiff);
    parts.flow.evaluate().unwrap();
    let mut fastest = 0.0_f64;
    while parts.flow.world.time < 0.2 {
        let dt = longest(&parts);
        step(&mut parts, dt);
        if parts.flow.world.time > 0.1 {
            let all = parts.flow.world.free.get(fields::VELOCITY).unwrap();
            fastest = all.iter().map(Vect::norm).fold(fastest, f64::max);
        }
    }
    println!("fastest {fastest:e} m/s");
    assert!(fastest < 1e-5, "{fastest} m/s after 0.1 s");
}

/// The same tilted by 33°, 3° more than stands: a layer gains 0.593 m/s². It begins to flow 0.2 s later than a soft one, since
/// what yielding leaves is known a step late; then its top gains 0.615 m/s².
#[test]
fn a_stiff_slope_that_is_too_steep_flows() {
    let steep = [
        "phase.sand.rheology.drucker-prager.young_modulus=1e9 numerics.gravity=[0,-8.227] \
         numerics.driving=[5.343,0]",
    ];
    let mut parts = with_implicit("resting-slope", &steep);
    parts.flow.evaluate().unwrap();
    let (half, whole) = (top_at(&mut parts, 0.5), top_at(&mut parts, 1.0));
    let gained = (whole - half) / 0.5;
    println!("{half} m/s after 0.5 s, then the top gains {gained} m/s²");
    close(gained, 0.593, 0.06, "m/s²");
    assert!(half > 0.1, "{half} m/s after 0.5 s, 0.24 with a soft soil");
}
