//! Taylor–Green vortices.

use crate::shipped::{finished, second_order, whole};

/// The budget: second order with 25 spacings to a vortex, and a quarter of M² = 0.01, by which pressures of ρU²/4 change
/// the density.
#[test]
fn taylor_green_at_50_squared_is_within_0_21_per_cent_and_decays_at_the_exact_rate_to_0_36() {
    let run = whole("taylor-green-2d");
    let budget = second_order(25.0) + 0.25 * 0.01;
    run.error("velocity-l1", budget, 0.0021);
    // Energy goes with the square of the velocity.
    run.error("decay", 2.0 * budget, 0.0036);
}

/// Pairs cancel to rounding: over Σ m|u| after 160 steps. Carrying the velocity while shifting would
/// not keep it to rounding.
#[test]
fn taylor_green_keeps_its_momentum() {
    let transport = "shifting.fickian.transport=density";
    let run = finished("taylor-green-2d", &["numerics.spacing=0.04", transport]);
    let drift = run.summary.drift.momentum;
    assert!(
        drift.abs() < 1e-12,
        "momentum over Σ m|u|: {drift:e}, measured 4e-17"
    );
}
