//! A drop under surface tension with 10 spacings to its radius.

use crate::shipped::{finished, second_order};

#[test]
fn the_drop_swings_with_the_period_of_the_viscous_linear_problem_to_0_32_per_cent() {
    let run = finished("oscillating-drop-2d", &["numerics.spacing=0.02"]);
    let budget = second_order(10.0);
    run.error("period", budget, 0.00318);
    // Viscosity lengthens the period by what the two linear problems differ, 1.75 %.
    let viscous = 0.24300 / 0.23882 - 1.0;
    run.error("period-inviscid", budget + viscous, 0.0143);
}
