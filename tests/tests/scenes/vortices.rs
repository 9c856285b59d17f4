//! Taylor–Green vortices with 25² particles.

use crate::shipped::finished;

#[test]
fn taylor_green_decays_at_the_exact_rate_to_3_3_per_cent_and_keeps_its_momentum() {
    let run = finished("taylor-green-2d", &["numerics.spacing=0.04"]);
    run.error("decay", 0.06, 0.0333);
    run.error("velocity-l1", 0.08, 0.0582);
    let drift = run.summary.drift.momentum;
    // Pairs cancel to rounding: over Σ m|u| after 110 steps.
    assert!(
        drift.abs() < 1e-12,
        "momentum over Σ m|u|: {drift:e}, measured 4e-17"
    );
}
