//! A drop under surface tension with 10 spacings to its radius.

use crate::shipped::finished;

#[test]
fn the_drop_swings_with_the_period_of_the_viscous_linear_problem_to_0_32_per_cent() {
    let run = finished("oscillating-drop-2d", &["numerics.spacing=0.02"]);
    run.error("period", 0.01, 0.00318);
    run.error("period-inviscid", 0.03, 0.0143);
}
