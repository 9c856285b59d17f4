//! Several phases in trouble: mixed, missing, lone, of extreme ratios. Every formulation runs them.
//!
//! A periodic box of 20 × 20 particles in motion; what is not refused must stay finite and keep
//! its mass and momentum.

use sph_core::{StepLimit, System, fields};
use sph_particles::setup::Assembled;
use sph_tests::{Says, assembled, below, momentum, refusal, scene};

const STEPS: usize = 60;
const FORMULATIONS: [&str; 4] = ["hu-adams", "colagrossi-landrini", "grenier", "krimi"];

const BOX: &str = include_str!("box.toml");

/// Runs with the steps that the plugins allow and checks what came of it.
fn survives(mut parts: Assembled<2>, what: &str) {
    let before = momentum(&parts);
    let mut time = 0.0;
    for step in 0..STEPS {
        let flow = &mut parts.flow;
        flow.evaluate()
            .unwrap_or_else(|e| panic!("{what}: step {step}: {e}"));
        let limits = flow.step_limits().unwrap();
        let dt = StepLimit::least(&limits).unwrap().dt;
        assert!(dt.is_finite() && dt > 0.0, "{what}: Δt = {dt}");
        flow.world.dt = dt;
        parts.integrator.step(flow, dt).unwrap();
        time += dt;
    }
    parts.flow.evaluate().unwrap();
    let free = &parts.flow.world.free;
    let fastest = free.get(fields::VELOCITY).unwrap().iter();
    let fastest = fastest
        .map(|u| u.norm())
        .fold(0.0, |a: f64, b| if b.is_nan() { b } else { a.max(b) });
    assert!(fastest < 2.0, "{what}: {fastest} m/s after {time} s");
    let drift = (momentum(&parts).0 - before.0).norm() / before.1;
    below(drift, 1e-12, what);
}

fn each(what: &str, overrides: &[&str], change: impl Fn(&mut Assembled<2>)) {
    for formulation in FORMULATIONS {
        let formulation = format!("formulation.{formulation}={{}}");
        let mut parts = assembled(&scene(BOX, &[overrides, &[&formulation]].concat()));
        change(&mut parts);
        survives(parts, &format!("{what}, {formulation}"));
    }
}

#[test]
fn phases_that_start_mixed_run() {
    each("mixed", &["phase.upper.density=100.0"], |parts| {
        let free = &mut parts.flow.world.free;
        let identity = free.get(fields::IDENTITY).unwrap().to_vec();
        let phase = free.get_mut(fields::PHASE).unwrap();
        for (p, id) in phase.iter_mut().zip(&identity) {
            *p = (id.wrapping_mul(2_654_435_761) >> 16) & 1;
        }
        let phase = phase.clone();
        let density = |k: usize| [1000.0, 100.0][phase[k] as usize];
        for k in 0..phase.len() {
            free.get_mut(fields::DENSITY).unwrap()[k] = density(k);
            free.get_mut(fields::MASS).unwrap()[k] = density(k) * 0.0025;
        }
        if let Ok(constant) = free.get_mut(fields::DENSITY_CONSTANT) {
            // As after a rebase on the lattice: K/ρ is the same for all.
            let share = constant[0] / 1000.0;
            constant
                .iter_mut()
                .enumerate()
                .for_each(|(k, c)| *c = density(k) * share);
        }
    });
}

#[test]
fn density_ratios_of_ten_thousand_run_both_ways() {
    each("heavy below", &["phase.upper.density=0.1"], |_| ());
    let upper = ["phase.lower.density=0.1", "phase.upper.density=1000.0"];
    each("heavy above", &upper, |_| ());
}

#[test]
fn viscosity_ratios_of_a_million_and_zero_viscosity_run() {
    let stiff = "phase.lower.rheology.newtonian.viscosity=1000.0";
    each("a million", &[stiff, "phase.upper.density=1000.0"], |_| ());
    let none = "phase.upper.rheology.newtonian.viscosity=0.0";
    each("one without", &[none], |_| ());
    let both = "phase.lower.rheology.newtonian.viscosity=0.0";
    each("both without", &[none, both], |_| ());
}

#[test]
fn a_phase_of_one_particle_runs() {
    let lone = "body.upper.box=[[0.5, 0.5], [0.551, 0.551]]";
    let rest = "body.lower.subtract=[{box=[[0.5, 0.5], [0.551, 0.551]]}]";
    let whole = "body.lower.box=[[0.0, 0.0], [1.0, 1.0]]";
    each("one", &[lone, rest, whole], |parts| {
        let phase = parts.flow.world.free.get(fields::PHASE).unwrap();
        assert_eq!(phase.iter().filter(|p| **p == 1).count(), 1);
    });
}

#[test]
fn a_phase_without_a_body_runs_as_if_it_were_not_there() {
    let lower = BOX.split("[body.upper]").next().unwrap();
    let text = lower.replace("[1.0, 0.5]", "[1.0, 1.0]");
    survives(assembled(&scene(&text, &[])), "no body");
}

#[test]
fn an_interface_of_one_phase_is_refused_with_the_reason() {
    let scene = BOX.split("[body.upper]").next().unwrap();
    let (before, rest) = scene.split_once("[phase.upper]").unwrap();
    let after = rest.split_once("[body.lower]").unwrap().1;
    let scene = format!("{before}[interface.micro-mixing]\n[body.lower]{after}");
    let refused = refusal::<2>(&scene);
    refused.says("interface.micro-mixing | one phase");
}
