//! The run: evaluate, write what is due, step; roll back what fails.

use std::collections::BTreeMap;
use std::ops::AddAssign;
use std::sync::Arc;

use sph_core::{StepError, StepLimit, System};
use sph_decomposition::Transport;
use sph_scene::Scene;
use sph_setup::all_ready;
use sph_solver::Snapshot;
use sph_solver::step::guard;

use crate::failure::error::RunError;
use crate::results::summary::{Status, Summary};
use crate::running::clock::standing_still;
use crate::running::course::Running;
use crate::running::driver::{Command, Observer, Progress};
use crate::running::next_step::next_step;
use crate::running::options::{RunOptions, Start};
use crate::running::ready::ready;

/// Runs a scene.
///
/// # Errors
/// A bad scene before anything is written; afterwards a failed step (with checkpoint and
/// picture of the bad state), or a file that cannot be written.
pub fn run(
    scene: &Scene,
    options: &RunOptions,
    observer: &mut (dyn Observer + Send),
) -> Result<Summary, RunError> {
    let summary = run_with(scene, options, None, observer)?;
    summary.ok_or_else(|| RunError::at("", "there is no summary of the run"))
}

/// Runs this rank's part of a scene, with the same scene and options on all ranks. The first rank alone writes, and has a summary.
///
/// The results are those of one process, to the bit, whatever the number of ranks.
///
/// # Errors
/// As [`run`], on all ranks; a scene that cannot be divided; a rank that has ended.
pub fn run_part(
    scene: &Scene,
    options: &RunOptions,
    ranks: Arc<dyn Transport>,
    observer: &mut (dyn Observer + Send),
) -> Result<Option<Summary>, RunError> {
    run_with(scene, options, Some(ranks), observer)
}

fn run_with(
    scene: &Scene,
    options: &RunOptions,
    ranks: Option<Arc<dyn Transport>>,
    observer: &mut (dyn Observer + Send),
) -> Result<Option<Summary>, RunError> {
    let pool = rayon::ThreadPoolBuilder::new()
        .num_threads(options.threads.unwrap_or(0))
        .build()
        .map_err(|e| RunError::at("--threads", e.to_string()))?;
    pool.install(|| match scene.dimension {
        3 => run_in::<3>(scene, options, ranks, observer),
        _ => run_in::<2>(scene, options, ranks, observer),
    })
}

fn run_in<const D: usize>(
    scene: &Scene,
    options: &RunOptions,
    ranks: Option<Arc<dyn Transport>>,
    observer: &mut (dyn Observer + Send),
) -> Result<Option<Summary>, RunError> {
    let mut lock = None;
    let ready = ready::<D>(scene, options, ranks.clone(), (&mut lock, &mut *observer));
    let mut running = match ranks {
        None => ready?,
        Some(ranks) => all_ready(&*ranks, ready)?,
    };
    let status = running.go(observer)?;
    running.finish(status)
}

/// The state before the last step, if any was kept.
#[derive(Default)]
struct LastGood<const D: usize> {
    snapshot: Snapshot<D>,
    taken: bool,
}

impl<const D: usize> LastGood<D> {
    fn state(&self) -> Option<&Snapshot<D>> {
        self.taken.then_some(&self.snapshot)
    }
}

/// Factor by which a rolled-back step recovers per good step.
pub(crate) const RECOVERY: f64 = 1.05;

/// Adds to what is counted under a name, which is written down when it first comes.
fn count<T: AddAssign + Default>(all: &mut BTreeMap<String, T>, name: &str, more: T) {
    match all.get_mut(name) {
        Some(sum) => *sum += more,
        None => *all.entry(name.to_string()).or_default() += more,
    }
}

impl<const D: usize> Running<'_, D> {
    fn go(&mut self, observer: &mut (dyn Observer + Send)) -> Result<Status, RunError> {
        let mut good = LastGood::default();
        match (&self.options.start, self.parts.flow.world.time) {
            (Start::Afresh, _) => self.counters.next_output = self.next_output(-1.0),
            (Start::From(_) | Start::Changed, time) => {
                self.counters.next_output = self.next_output(time);
            }
            (Start::Resumed, _) => {}
        }
        loop {
            if let Err(cause) = self.evaluate() {
                self.go_back(cause, good.state(), observer)?;
                continue;
            }
            if let Some(status) = self.look(&good, observer)? {
                return Ok(status);
            }
            if let Err(cause) = self.step(&mut good, observer)? {
                self.go_back(cause, good.state(), observer)?;
                continue;
            }
            let stop = match self.is_to_stop(observer) {
                Ok(stop) => stop,
                Err(cause) => {
                    self.go_back(cause, good.state(), observer)?;
                    continue;
                }
            };
            if stop {
                // The rates belong to a state; a checkpoint is taken where they are fresh.
                if let Err(cause) = self.evaluate() {
                    return Err(self.fail(cause, good.state(), observer));
                }
                self.save()?;
                return Ok(Status::Interrupted);
            }
        }
    }

    /// Writes what is due at an evaluated state; tells whether the run is over.
    fn look(
        &mut self,
        good: &LastGood<D>,
        observer: &mut (dyn Observer + Send),
    ) -> Result<Option<Status>, RunError> {
        if good.taken && f64::from_bits(self.counters.step_scale) >= 1.0 {
            self.counters.retries = 0;
        }
        let time = self.parts.flow.world.time;
        if self.is_due(time).any() {
            let written = self.write_what_is_due(time, observer);
            self.all_have_written(written)?;
            let verdict = self.mach.verdict(self.scene);
            let verdict = verdict.or_else(|| self.departure.verdict());
            if let Some(cause) = self.agreed(verdict) {
                return Err(self.fail(cause, good.state(), observer));
            }
        }
        if time >= self.scene.run.end {
            let verdict = self.parts.flow.reports().find_map(|r| r.verdict);
            let verdict = verdict.or_else(|| self.energy.verdict());
            if let Some(cause) = self.agreed(verdict) {
                return Err(self.fail(cause, good.state(), observer));
            }
            return Ok(Some(Status::Done));
        }
        let most = self.scene.run.max_steps;
        if most.is_some_and(|m| self.counters.steps >= m) {
            observer.message("the largest number of steps is reached");
            self.save()?;
            return Ok(Some(Status::Interrupted));
        }
        Ok(None)
    }

    /// One step from an evaluated state, which is kept; what went wrong in it, if something did.
    fn step(
        &mut self,
        good: &mut LastGood<D>,
        observer: &mut (dyn Observer + Send),
    ) -> Result<Result<(), StepError>, RunError> {
        let (time, end) = (self.parts.flow.world.time, self.scene.run.end);
        let (dt, limiter) = match self.chosen_step(time, end)? {
            Ok(chosen) => chosen,
            Err(cause) => return Ok(Err(cause)),
        };
        if self.scene.run.retries > 0 {
            good.snapshot.take(&self.parts.flow)?;
            good.taken = true;
        }
        if let Some(cause) = standing_still(time, dt, self.target(end), limiter) {
            return Err(self.fail(cause, good.state(), observer));
        }
        self.tried = (dt, limiter);
        self.parts.flow.world.dt = dt;
        let flow = &mut self.parts.flow;
        let stepped = self.parts.integrator.step(flow, dt);
        let stepped = stepped.and_then(|()| flow.let_out(dt));
        if let Err(cause) = stepped.and_then(|()| flow.let_in(dt)) {
            return Ok(Err(cause));
        }
        // A drift in parts may end one rounding short of its aim, and the sliver that is left
        // be too short for its parts to move the clock: for ever.
        let target = self.target(end);
        if time + dt >= target * (1.0 - 1e-12) {
            self.parts.flow.world.time = target;
        }
        self.counters.steps += 1;
        count(&mut self.counters.limited, limiter, 1);
        let scale = f64::from_bits(self.counters.step_scale);
        self.counters.step_scale = (scale * RECOVERY).min(1.0).to_bits();
        Ok(Ok(()))
    }

    /// Tells of a step that is done; whether somebody or the clock on the wall asks to stop.
    fn is_to_stop(&mut self, observer: &mut (dyn Observer + Send)) -> Result<bool, StepError> {
        let (dt, limiter) = self.tried;
        let command = observer.step(&Progress {
            time: self.parts.flow.world.time,
            end: self.scene.run.end,
            step: self.counters.steps,
            dt,
            limiter,
            particles: self.parts.flow.world.free.len(),
        });
        let most = self.scene.run.max_wall;
        let stop = command == Command::Stop || most.is_some_and(|m| self.wall_seconds() > m);
        self.parts.flow.any_rank(stop)
    }

    pub(crate) fn evaluate(&mut self) -> Result<(), StepError> {
        let flow = &mut self.parts.flow;
        let bounds = self.scene.numerics.density_bounds;
        let done = flow.evaluate();
        let done = done.and_then(|()| guard::rates(&flow.world, &flow.laws, bounds));
        let most = &mut self.counters.stage_bytes;
        most.resize(flow.stages.len(), 0);
        for (most, stage) in most.iter_mut().zip(&flow.stages) {
            *most = stage.bytes().max(*most);
        }
        // No rank goes on to what is done with an evaluated state if another has none.
        match self.agreed(done.err()) {
            None => Ok(()),
            Some(cause) => Err(cause),
        }
    }

    pub(crate) fn wall_seconds(&self) -> f64 {
        self.counters.wall_seconds + self.started.elapsed().as_secs_f64()
    }

    pub(crate) fn next_output(&self, time: f64) -> Option<u64> {
        self.scene
            .output
            .next_after(time, self.scene.run.end)
            .map(f64::to_bits)
    }

    /// The next step and what limits it, noted with all bounds.
    fn chosen_step(
        &mut self,
        time: f64,
        end: f64,
    ) -> Result<Result<(f64, &'static str), StepError>, RunError> {
        let mut limits = std::mem::take(&mut self.limits);
        let flow = &mut self.parts.flow;
        flow.step_limits_into(&mut limits)?;
        let chosen = flow.least_limits(&mut limits).map(|()| {
            self.note_bounds(&limits);
            self.choose_step(&limits, time, end)
        });
        self.limits = limits;
        Ok(chosen)
    }

    fn note_bounds(&mut self, limits: &[StepLimit]) {
        for limit in limits.iter().filter(|l| l.dt > 0.0) {
            count(&mut self.counters.bounds, limit.name, 1.0 / limit.dt);
        }
    }

    /// The next time that is hit exactly.
    fn target(&self, end: f64) -> f64 {
        let output = self.counters.next_output.map_or(end, f64::from_bits);
        output.min(end)
    }

    /// The least limit, cut so that output times and the end are hit exactly.
    fn choose_step(&self, limits: &[StepLimit], time: f64, end: f64) -> (f64, &'static str) {
        let factor = self.scene.run.safety * f64::from_bits(self.counters.step_scale);
        next_step(limits, factor, [time, self.target(end)], end)
    }

    pub(crate) fn stage_seconds(&self) -> BTreeMap<String, f64> {
        let mut all = self.counters.stage_seconds.clone();
        for timing in self.parts.flow.timings() {
            *all.entry(timing.name.clone()).or_default() += timing.spent.as_secs_f64();
        }
        *all.entry("output".into()).or_default() += self.output_seconds;
        all
    }

    fn finish(&mut self, status: Status) -> Result<Option<Summary>, RunError> {
        self.gather(self.looks_around())?;
        self.look_around()?;
        self.share()?;
        let Some(files) = &self.files else {
            return Ok(None);
        };
        files.outputs.animate()?;
        self.write_summary(status, None).map(Some)
    }
}
