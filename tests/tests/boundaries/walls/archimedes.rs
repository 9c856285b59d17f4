//! Forces of water at rest: the weight on a tank, the displaced weight on what is under water.

use crate::walls::bench::{Flowing, flowing};

const GRAVITY: f64 = 9.81;
const DENSITY: f64 = 1000.0;

/// Water in a tank of unit width, `depth` high, with further walls; as much viscosity as brings
/// it to rest.
fn tank<const D: usize>(treatment: &str, spacing: f64, walls: &str, depth: f64) -> Flowing<D> {
    let (low, high, down, top) = match D {
        2 => (
            "0.0, 0.0",
            "1.0, 1.4",
            "0.0, -9.81",
            format!("1.0, {depth}"),
        ),
        _ => (
            "0.0, 0.0, 0.0",
            "1.0, 1.0, 1.4",
            "0.0, 0.0, -9.81",
            format!("1.0, 1.0, {depth}"),
        ),
    };
    let text = format!(
        r#"
title = "tank"
dimension = {D}
run.end = 10.0
[numerics]
spacing = {spacing}
gravity = [{down}]
relax = {{ steps = 100, tolerance = 0.005 }}
[smoother.brezzi-pitkaranta]
strength = 0.4
[walls.{treatment}]
[wall.tank]
box = [[{low}], [{high}]]
{walls}
[phase.water]
density = {DENSITY}
[phase.water.rheology.newtonian]
viscosity = "20 Pa s"
[body.water]
phase = "water"
box = [[{low}], [{top}]]
clip = true
pressure = "hydrostatic"
"#
    );
    flowing(&text, &[])
}

/// Forces over many steps: the mean upward ones by reaction and by pressure.
fn upward<const D: usize>(flow: &mut Flowing<D>, wall: &str, from: f64, to: f64) -> [f64; 2] {
    flow.until(from);
    let (mut sum, mut count) = ([0.0; 2], 0.0);
    while flow.0.flow.world.time < to {
        flow.step();
        let force = flow.force(wall);
        sum[0] += force.force[D - 1];
        sum[1] += force.pressure_force[D - 1];
        count += 1.0;
    }
    sum.map(|s| s / count)
}

#[test]
fn a_tank_bears_the_weight_of_its_particles_to_1e_4_and_the_pressure_that_of_the_depth_to_2_per_cent()
 {
    let mut flow = tank::<2>("usaw", 0.05, "", 0.825);
    let [reaction, pressure] = upward(&mut flow, "tank", 1.5, 2.0);
    let of_particles = reaction / flow.weight()[1];
    let of_depth = pressure / (-DENSITY * GRAVITY * 0.825);
    println!("reaction {of_particles:.5} of the weight, pressure {of_depth:.4} of ρ g H L");
    assert!((of_particles - 1.0).abs() < 1e-4, "{of_particles}");
    assert!((of_depth - 1.0).abs() < 0.02, "{of_depth}");
}

const BLOCK: &str = r#"
[wall.block]
box = [[0.3, 0.3], [0.7, 0.6]]
fluid = "outside"
"#;

/// The wall points stand for fluid half a spacing thick which has no weight: the particles lift
/// the block and that fluid. The pressure is that at the wall itself.
#[test]
fn particles_lift_a_block_and_half_a_spacing_around_it_the_pressure_the_block_to_3_per_cent() {
    let mut flow = tank::<2>("usaw", 0.05, BLOCK, 0.925);
    let [reaction, pressure] = upward(&mut flow, "block", 1.5, 2.0);
    let displaced = DENSITY * GRAVITY * 0.4 * 0.3;
    let with_layer = DENSITY * GRAVITY * 0.45 * 0.35;
    let [by_particles, by_pressure] = [reaction / with_layer, pressure / displaced];
    println!("block: reaction {by_particles:.4}, pressure {by_pressure:.4}");
    assert!((by_particles - 1.0).abs() < 0.03, "{by_particles}");
    assert!((by_pressure - 1.0).abs() < 0.03, "{by_pressure}");
}

#[test]
fn dummies_lift_a_block_by_the_displaced_weight_to_1_per_cent() {
    let mut flow = tank::<2>("dummy-particles", 0.05, BLOCK, 0.925);
    let [reaction, pressure] = upward(&mut flow, "block", 1.5, 2.0);
    let displaced = DENSITY * GRAVITY * 0.4 * 0.3;
    println!("dummies: {:.4}", reaction / displaced);
    assert!((reaction / displaced - 1.0).abs() < 0.01);
    assert_eq!(pressure, 0.0, "there are no elements");
}

#[test]
fn the_pressure_lifts_a_ball_of_five_spacings_by_the_displaced_weight_to_6_per_cent() {
    let ball = r#"
[wall.ball]
sphere = { centre = [0.5, 0.5, 0.45], radius = 0.25 }
fluid = "outside"
"#;
    let mut flow = tank::<3>("usaw", 0.1, ball, 0.85);
    let [_, pressure] = upward(&mut flow, "ball", 0.25, 0.35);
    let displaced = DENSITY * GRAVITY * 0.25_f64.powi(3) * 4.0 / 3.0 * std::f64::consts::PI;
    println!("ball: {:.4}", pressure / displaced);
    assert!((pressure / displaced - 1.0).abs() < 0.06);
}
