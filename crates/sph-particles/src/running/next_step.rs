//! The length of the step to come.

use sph_core::StepLimit;

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
