//! A few steps of a scene, to see how long the whole of it will take.

use std::time::{Duration, Instant};

use sph_core::StepError;
use sph_scene::Scene;
use sph_solver::{Snapshot, SolverError};

use crate::failure::error::{Result, RunError};
use crate::running::run::on_threads;
use crate::setup::{Examination, examine_in};
use crate::zones::{Coupling, Stepper, attach};

/// Least number of steps, where there is time for them.
const FEWEST: usize = 32;
/// Relative change from a quarter of the steps to the half that follows, below which further steps do not change the
/// estimate.
const SETTLED: f64 = 0.1;

/// Cost of the first steps of a scene.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Trial {
    /// Steps that were timed.
    pub steps: usize,
    /// Mean time step, s.
    pub dt: f64,
    /// Wall-clock time of one step, s.
    pub seconds: f64,
    /// Wall-clock time over simulated time of a scene with zones if it had none.
    pub without_zones: Option<f64>,
}

/// As [`examine`](crate::setup::examine), and a trial of the first steps on `threads` threads: it ends where time step and
/// wall-clock time have settled, and after `budget` in any case. None is where there is nothing to step.
///
/// # Errors
/// Every problem of the scene, with its path. That of the trial is apart: a scene whose first steps fail is known.
pub fn examine_and_try(
    scene: &Scene,
    threads: usize,
    budget: Duration,
) -> Result<(Examination, Result<Option<Trial>, RunError>)> {
    on_threads(Some(threads), || match scene.dimension {
        3 => examined_and_tried::<3>(scene, budget),
        _ => examined_and_tried::<2>(scene, budget),
    })?
}

fn examined_and_tried<const D: usize>(
    scene: &Scene,
    budget: Duration,
) -> Result<(Examination, Result<Option<Trial>, RunError>)> {
    let (mut examined, assembled) = examine_in::<D>(scene)?;
    let zones = attach(scene, &assembled)?;
    examined.zones = zones.sizes();
    if scene.zone.is_empty() {
        let mut stepper = Stepper::from_parts(scene, assembled, zones);
        let tried = timed(scene, &mut stepper, budget);
        return Ok((examined, tried.map_err(Into::into)));
    }
    let mut start = Snapshot::default();
    start.take(&assembled.flow).map_err(SolverError::from)?;
    let none = Coupling::new(&assembled, None, Vec::new());
    let mut alone = Stepper::from_parts(scene, assembled, none);
    let coarse = timed(scene, &mut alone, budget / 2);
    let mut assembled = alone.parts;
    let restored = start.restore(&mut assembled.flow);
    restored.map_err(SolverError::from)?;
    let mut stepper = Stepper::from_parts(scene, assembled, zones);
    let both = coarse.and_then(|coarse| {
        let mut with_zones = timed(scene, &mut stepper, budget / 2)?;
        if let (Some(trial), Some(coarse)) = (&mut with_zones, coarse) {
            trial.without_zones = Some(coarse.seconds / coarse.dt);
        }
        Ok(with_zones)
    });
    Ok((examined, both.map_err(Into::into)))
}

fn timed<const D: usize>(
    scene: &Scene,
    stepper: &mut Stepper<D>,
    budget: Duration,
) -> Result<Option<Trial>, StepError> {
    let end = scene.run.end;
    let began = Instant::now();
    let mut taken = vec![(stepper.time(), 0.0)];
    // Means over steps `from` to `to`: the time step and the wall-clock time.
    let means = |taken: &[(f64, f64)], from: usize, to: usize| {
        let steps = (to - from) as f64;
        let [first, last] = [taken[from], taken[to]];
        [(last.0 - first.0) / steps, (last.1 - first.1) / steps]
    };
    while stepper.time() < end && began.elapsed() < budget {
        stepper.step(end)?;
        taken.push((stepper.time(), began.elapsed().as_secs_f64()));
        let steps = taken.len() - 1;
        if steps >= FEWEST && steps.is_power_of_two() {
            let before = means(&taken, steps / 4, steps / 2);
            let after = means(&taken, steps / 2, steps);
            if (0..2).all(|k| (after[k] - before[k]).abs() < SETTLED * after[k]) {
                break;
            }
        }
    }
    // The later half: lists, caches and the first guesses of solvers are cold before.
    let last = taken.len() - 1;
    let first = (taken.len() / 2).min(last.saturating_sub(1));
    let [dt, seconds] = means(&taken, first, last);
    Ok((last > first).then_some(Trial {
        steps: last - first,
        dt,
        seconds,
        without_zones: None,
    }))
}
