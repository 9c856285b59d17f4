//! Solids that rest between walls.

use sph_tests::{ran, scene};

/// 0.3 m wide and high, of fine grains: their yield viscosity η_y damps nothing.
const BLOCK: &str = r#"
title = "A block of soil between walls"
dimension = 2
run.end = 0.3
numerics = { spacing = 0.02, smoothing_ratio = 2.0, gravity = [0.0, -9.81] }
formulation.hu-adams = {}
viscous-operator.monaghan-gingold = { within = "arithmetic" }
implicit-viscosity.backward-euler = {}
walls.usaw = { vertices = true }
[wall.box]
polyline = [[0.0, 0.5], [0.0, 0.0], [0.3, 0.0], [0.3, 0.5]]
condition = "free-slip"
[phase.silt]
density = 1240.0
speed_of_sound = 18.0
equation-of-state.tait = {}
[phase.silt.rheology.drucker-prager]
young_modulus = 3e5
poisson_ratio = 0.3
friction_angle = "25 deg"
grain_diameter = 3e-5
grain_density = 1400.0
[body.block]
phase = "silt"
box = [[0.0, 0.0], [0.3, 0.3]]
pressure = "hydrostatic"
[output]
vtk = false
"#;

/// Kinetic energy after 0.3 s, J.
fn energy(overrides: &[&str]) -> f64 {
    let ran = ran(&scene(BLOCK, overrides), 1).unwrap_or_else(|e| panic!("{e}"));
    ran.summary.kinetic_energy
}

/// A hundredth of a spacing of fall is the energy m g δr/100.
#[test]
fn soil_between_walls_does_not_rattle() {
    let fall = 1240.0 * 0.09 * 9.81 * 0.02 / 100.0;
    for condition in ["free-slip", "no-slip"] {
        let condition = format!("wall.box.condition={condition}");
        let rests = energy(&[&condition]);
        let rattles = energy(&[&condition, "elastic-force.divergence.hourglass=0"]);
        println!("{condition}: {rests:.2e} J, without damping {rattles:.2e} J of {fall:.2e} J");
        assert!(rests < 0.1 * fall, "{rests} J");
        assert!(rattles > fall, "it makes no difference: {rattles} J");
    }
}
