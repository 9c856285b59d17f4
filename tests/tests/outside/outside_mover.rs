//! The mover of `examples/winch`.

use sph_boundary::RigidState;
use sph_tests::{below, ran, scene, within};
use winch as _;

/// A block under water, away from the walls.
const SCENE: &str = include_str!("winch.toml");

/// Velocity of the block at the end, m/s.
fn velocity(changes: &[&str]) -> f64 {
    let ran = ran(&scene(SCENE, changes), 1).unwrap_or_else(|e| panic!("{e}"));
    let state = RigidState::<2>::from_numbers(&ran.state().reals("wall_states"));
    state.expect("a state").velocity[1]
}

/// Of a block of 0.04 m² water bears ρ g A = 392.4 N/m. Sound goes round in the tank ten times in 0.3 s, and a mean over as many swings
/// leaves at most a twentieth of their size; measured: 0.5 %.
#[test]
fn a_winch_that_pulls_with_weight_less_buoyancy_holds_the_block() {
    let buoyancy = 1000.0 * 9.81 * 0.04;
    let weight = 400.0 * 9.81;
    let pull = format!("wall.block.mover.winch.pull={}", weight - buoyancy);
    let held = velocity(&[&pull, "run.end=0.3"]);
    let share = held / (0.3 * buoyancy / 400.0);
    below(share, 0.05, "share of what buoyancy alone gives");
    // Without the winch all of it falls with g less buoyancy, and carries some water along.
    let free = velocity(&[]);
    let fall = -0.05 * 9.81 * (1.0 - buoyancy / weight);
    within(free / fall, 0.8..1.05, "share of the fall alone");
}
