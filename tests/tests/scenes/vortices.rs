//! Taylor–Green vortices with 25² particles.

use crate::shipped::finished;

#[test]
fn taylor_green_at_25_squared_is_within_0_93_per_cent_and_decays_at_the_exact_rate_to_1() {
    let run = finished("taylor-green-2d", &["numerics.spacing=0.04"]);
    run.error("decay", 0.01, 0.00515);
    run.error("velocity-l1", 0.0093, 0.00714);
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
