//! A drop under surface tension with 10 spacings to its radius.

use crate::shipped::finished;

/// 3 % is what the validation asks for. Places that differ by 1e-6 and 1e-5 of a spacing gave 0.1 and 1.0 %, other orders of
/// sums 0.7 to 1.3 %: the lattice breaks up as rounding has it.
#[test]
fn the_drop_swings_with_the_period_of_the_viscous_linear_problem_to_1_3_per_cent() {
    let run = finished("oscillating-drop-2d", &["numerics.spacing=0.02"]);
    let budget = 0.03;
    run.error("period", budget, 0.01325);
    // Viscosity lengthens the period by what the two linear problems differ, 1.75 %.
    let viscous = 0.24300 / 0.23882 - 1.0;
    run.error("period-inviscid", budget + viscous, 0.03099);
}
