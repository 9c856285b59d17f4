//! The forces on the walls with the weight are the whole change of momentum.

use sph_core::Vect;

use crate::walls::bench::{Flowing, flowing};

const FLUID: &str = r#"
[smoother.brezzi-pitkaranta]
strength = 0.04
[phase.water]
density = 1000.0
velocity_scale = 3.0
[phase.water.rheology.newtonian]
viscosity = "1 Pa s"
"#;

/// Water falls against a paddle that turns in a tank: two walls, one of them moving.
fn paddle(treatment: &str) -> Flowing<2> {
    flowing(&format!(
        r#"
title = "paddle"
dimension = 2
run.end = 1.0
[numerics]
spacing = 0.04
gravity = [0.5, -9.81]
[walls.{treatment}]
[wall.tank]
box = [[0.0, 0.0], [1.2, 1.2]]
[wall.paddle]
polyline = [[0.42, 0.2], [0.62, 0.36]]
thickness = 0.08
motion.rotate = {{ centre = [0.52, 0.28], speed = 3.0 }}
[body.water]
phase = "water"
box = [[0.0, 0.0], [1.2, 0.5]]
clip = true
pressure = "hydrostatic"
{FLUID}"#
    ))
}

/// A driven channel, periodic along x, with a bump on its floor.
fn channel() -> Flowing<2> {
    flowing(&format!(
        r#"
title = "channel"
dimension = 2
run.end = 1.0
[numerics]
spacing = 0.05
driving = [4.0, 0.0]
periodic = {{ x = [0.0, 1.5] }}
[shifting]
[walls.usaw]
vertices = true
[wall.floor]
polyline = [[0.0, 0.0], [0.5, 0.0], [0.75, 0.2], [1.0, 0.0], [1.5, 0.0]]
[wall.lid]
polyline = [[1.5, 1.0], [0.0, 1.0]]
condition = "partial-slip"
slip_length = 0.1
[body.water]
phase = "water"
box = [[0.0, 0.0], [1.5, 1.0]]
velocity = [1.0, 0.0]
clip = true
{FLUID}"#
    ))
}

/// Water runs against a block that slides along the floor of a tank.
fn block(treatment: &str) -> Flowing<3> {
    flowing(&format!(
        r#"
title = "block"
dimension = 3
run.end = 1.0
[numerics]
spacing = 0.05
gravity = [0.5, 0.0, -9.81]
[walls.{treatment}]
[wall.tank]
box = [[0.0, 0.0, 0.0], [0.8, 0.4, 0.8]]
[wall.block]
box = [[0.3, 0.1, 0.0], [0.5, 0.3, 0.2]]
fluid = "outside"
motion.velocity = [0.5, 0.0, 0.0]
[body.water]
phase = "water"
box = [[0.0, 0.0, 0.0], [0.8, 0.4, 0.4]]
clip = true
pressure = "hydrostatic"
{FLUID}"#
    ))
}

/// Largest |Σ m a − weight + Σ F| over Σ m |a|, and the largest |Σ F| over the weight.
fn imbalance<const D: usize>(mut flow: Flowing<D>, steps: usize, what: &str) -> f64 {
    let (mut worst, mut least): (f64, f64) = (0.0, f64::INFINITY);
    for _ in 0..steps {
        flow.step();
        let forces = flow.forces();
        assert_eq!(forces.len(), 2);
        let on_walls: Vect<D> = forces.iter().map(|(_, f)| f.force).sum();
        let (rate, scale) = flow.momentum_rate();
        worst = worst.max((rate - flow.weight() + on_walls).norm() / scale);
        let each = forces.iter().map(|(_, f)| f.force.norm());
        least = least.min(each.fold(f64::INFINITY, f64::min) / flow.weight().norm());
    }
    println!("{what}: {worst:.1e} of Σ m |a|; no force below {least:.1e} of the weight");
    assert!(least > 1e-4, "{what}: a wall without a force");
    worst
}

#[test]
fn in_the_plane_forces_weight_and_driving_balance_to_1e_13() {
    for (what, flow) in [
        ("usaw", paddle("usaw")),
        ("dummies", paddle("dummy-particles")),
        ("channel", channel()),
    ] {
        assert!(imbalance(flow, 25, what) < 1e-13, "{what}");
    }
}

#[test]
fn in_space_forces_and_weight_balance_to_1e_13() {
    for treatment in ["usaw", "dummy-particles"] {
        let flow = block(treatment);
        assert!(imbalance(flow, 8, treatment) < 1e-13, "{treatment}");
    }
}

/// Over a step of semi-implicit Euler Δ(Σ m u) is Δt times the rate at its beginning.
#[test]
fn the_momentum_changes_by_the_time_step_times_the_forces_to_1e_11() {
    let mut flow = paddle("usaw");
    flow.steps(10);
    for _ in 0..5 {
        let before = flow.momentum();
        let forces = flow.forces();
        let on_walls: Vect<2> = forces.iter().map(|(_, f)| f.force).sum();
        let (expected, scale) = (flow.weight() - on_walls, flow.momentum_rate().1);
        let dt = flow.step();
        let change = (flow.momentum() - before) / dt;
        let error = (change - expected).norm() / scale;
        println!("ΔP/Δt: {error:.1e} of Σ m |a|");
        assert!(error < 1e-11, "{error:e}");
    }
}
