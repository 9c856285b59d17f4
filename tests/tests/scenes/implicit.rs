//! Implicit viscosity: beyond the explicit bound, across a jump of viscosity, beside the explicit scheme.

use crate::shipped::{finished, second_order};

/// Steps 16 500 times the explicit bound of 4.9e-6 s.
#[test]
fn creep_is_stable_far_beyond_the_explicit_bound_and_within_0_1_per_cent() {
    let run = finished("poiseuille-creep", &[]);
    run.error("profile", second_order(32.0), 0.00069);
    let summary = &run.summary;
    let mean_step = summary.simulated_seconds / summary.steps as f64;
    assert!(mean_step > 1e4 * 4.88e-6, "mean step {mean_step}");
    assert!(!summary.dt_limiters.contains_key("viscosity"));
}

#[test]
fn a_viscosity_jump_of_a_million_passes_the_stress_on_to_0_007_per_cent() {
    let run = finished("viscosity-jump", &[]);
    // A steady stress is the same in every row, to what 6 h²/ν leave of the start and what rows feel that slide.
    let left = (-6.0 * std::f64::consts::PI.powi(2) / 4.0_f64).exp();
    let rows_that_slide = 0.9e-4;
    run.error("stress-above", left + rows_that_slide, 6.6e-5);
    run.error("stress-below", left + rows_that_slide, 5.3e-5);
}

#[test]
fn explicit_and_implicit_errors_of_the_layered_channel_agree_within_a_tenth_of_a_per_cent() {
    let size = ["numerics.spacing=0.04 numerics.periodic.x=[0,0.48] \
         wall.bottom.polyline=[[0,-0.5],[0.48,-0.5]] wall.top.polyline=[[0.48,0.5],[0,0.5]] \
         body.heavy.box=[[0,-0.5],[0.48,0.5]] body.light.box=[[0,-0.5],[0.48,0.5]] run.end=1 \
         reference.profile.window=[0.5,1]"];
    let name = "bifluid-poiseuille-re0p125-implicit";
    let implicit = finished(name, &size);
    let explicitly = ["implicit-viscosity={}", "linear-solver={}"];
    let explicit = finished(name, &[&size[..], &explicitly[..]].concat());
    // Twelve rows to each fluid.
    let i = implicit.error("profile", second_order(12.5), 0.0035);
    let e = explicit.error("profile", second_order(12.5), 0.0035);
    assert!((i / e - 1.0).abs() < 0.001, "implicit {i}, explicit {e}");
    assert!(implicit.summary.steps * 4 < explicit.summary.steps);
}
