//! The length of the step to come.

use sph_core::{StepError, StepLimit};

/// Factor by which a rolled-back step recovers per good step.
pub(crate) const RECOVERY: f64 = 1.05;

/// The least limit times `factor`, cut so that `target` (s) is hit exactly, and the name of its limit.
///
/// Without any limit the step is `longest`.
pub fn next_step(
    limits: &[StepLimit],
    factor: f64,
    [time, target]: [f64; 2],
    longest: f64,
) -> (f64, &'static str) {
    let least = StepLimit::least(limits);
    let (dt, name) = least.map_or((longest, "none"), |l| (l.dt * factor, l.name));
    let left = target - time;
    match left {
        left if left <= dt => (left, name),
        // Two even steps instead of a full one and a sliver.
        left if left < 2.0 * dt => (0.5 * left, name),
        _ => (dt, name),
    }
}

/// The error of a run whose steps have become too short to move its clock.
pub fn standing_still(time: f64, dt: f64, target: f64, limiter: &str) -> Option<StepError> {
    // The rest of the way to an output may be as short: it is made up for after the step.
    let moves = time + dt > time || time + dt >= target * (1.0 - 1e-12);
    let reason = || {
        format!(
            "a step of {dt:.1e} s, which `{limiter}` allows, does not move it any more: lower the stiffness, the \
             viscosity or the speed behind it, or raise `run.safety`"
        )
    };
    (!moves).then(|| StepError::stage("clock", reason()))
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
