//! Check that the clock of a run still moves.

use sph_core::StepError;

/// The error of a run whose steps have become too short to move its clock.
pub(crate) fn standing_still(time: f64, dt: f64, target: f64, limiter: &str) -> Option<StepError> {
    // The rest of the way to an output may be as short: it is made up for after the step.
    let moves = time + dt > time || time + dt >= target * (1.0 - 1e-12);
    (!moves).then(|| StepError::stage("clock", format!(
            "a step of {dt:.1e} s, which `{limiter}` allows, does not move it any more: lower the stiffness, the \
             viscosity or the speed behind it, or raise `run.safety`"
        )))
}

#[cfg(test)]
mod tests {
    use super::standing_still;

    /// Later steps may become as short as the first may not be.
    #[test]
    fn a_clock_that_no_step_moves_ends_the_run() {
        let told = standing_still(0.02, 1e-20, 0.3, "viscosity").expect("it stands");
        let told = told.to_string();
        assert!(told.contains("`viscosity` allows"), "{told}");
        assert!(standing_still(0.02, 1e-4, 0.3, "sound").is_none());
        // The sliver before an output is made up for after the step.
        let target = 0.3;
        assert!(standing_still(target - 1e-17, 1e-17, target, "output").is_none());
    }
}
