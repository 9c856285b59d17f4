//! The forces on the walls with the weight are the whole change of momentum.

use sph_core::Vect;

use crate::walls::bench::{Flowing, flowing};

/// Water falls against a paddle that turns in a tank: two walls, one of them moving.
fn paddle(treatment: &str) -> Flowing<2> {
    let walls = format!("walls={{{treatment}={{}}}}");
    flowing(include_str!("paddle.toml"), &[&walls])
}

/// A driven channel, periodic along x, with a bump on its floor.
fn channel() -> Flowing<2> {
    flowing(include_str!("channel.toml"), &[])
}

/// Water runs against a block that slides along the floor of a tank.
fn block(treatment: &str) -> Flowing<3> {
    let walls = format!("walls={{{treatment}={{}}}}");
    flowing(include_str!("block.toml"), &[&walls])
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
