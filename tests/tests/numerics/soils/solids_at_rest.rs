//! Solids that rest between walls.

use sph_tests::{ran, scene};

/// 0.3 m wide and high, of fine grains: their yield viscosity η_y damps nothing.
const BLOCK: &str = include_str!("block.toml");

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
