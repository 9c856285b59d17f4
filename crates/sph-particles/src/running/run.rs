//! A run, and the steps that it takes.

use std::collections::BTreeMap;
use std::ops::AddAssign;
use std::sync::Arc;

use sph_core::StepError;
use sph_neighbours::Nearby;
use sph_neighbours::decomposition::{Thread, Transport};
use sph_run::{Opened, RunOptions, Schedule, Start, Status, Watch};
use sph_scene::Scene;
use sph_solver::step::guard;

use crate::failure::error::Result;
use crate::running::counters::Counters;
use crate::running::course::{DerivedState, Running};
use crate::running::next_step::{RECOVERY, next_step, standing_still};
use crate::running::output::outlay;
use crate::running::ranked;
use crate::running::series::Extrema;
use crate::running::watches::{DepartureWatch, EnergyWatch, MachWatch};
use crate::setup::{all_ready, assembled, readable, refuse_the_indivisible, rehearse, short_steps};
use crate::zones::attach;
use crate::{RunError, Summary};

/// Runs a scene.
///
/// # Errors
/// A bad scene before anything is written; afterwards a failed step (with checkpoint and
/// picture of the bad state), or a file that cannot be written.
pub fn run(scene: &Scene, options: &RunOptions, observer: &mut Watch<'_>) -> Result<Summary> {
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
    observer: &mut Watch<'_>,
) -> Result<Option<Summary>> {
    run_with(scene, options, Some(ranks), observer)
}

fn run_with(
    scene: &Scene,
    options: &RunOptions,
    ranks: Option<Arc<dyn Transport>>,
    observer: &mut Watch<'_>,
) -> Result<Option<Summary>> {
    on_threads(options.threads, || match scene.dimension {
        3 => run_in::<3>(scene, options, ranks, observer),
        _ => run_in::<2>(scene, options, ranks, observer),
    })?
}

/// Results on so many threads; without a number on one for each core.
pub fn on_threads<T: Send>(threads: Option<usize>, work: impl FnOnce() -> T + Send) -> Result<T> {
    let builder = rayon::ThreadPoolBuilder::new();
    let pool = builder.num_threads(threads.unwrap_or(0)).build();
    let pool = pool.map_err(|e| RunError::at("--threads", e.to_string()))?;
    Ok(pool.install(work))
}

fn run_in<const D: usize>(
    scene: &Scene,
    options: &RunOptions,
    ranks: Option<Arc<dyn Transport>>,
    observer: &mut Watch<'_>,
) -> Result<Option<Summary>> {
    let begun = ready::<D>(scene, options, ranks.clone()).and_then(|mut running| {
        let writes = running.writes();
        let outlay = writes.then(|| outlay(scene, &running.parts.probes));
        let opened = Opened::open(&mut running, options, outlay, observer)?;
        for warning in &running.parts.warnings {
            observer.message(&format!("note: {warning}"));
        }
        for zone in running.zones.sizes() {
            let (name, spacing, particles) = (zone.name, zone.spacing, zone.particles);
            observer.message(&format!(
                "zone `{name}` starts with {particles} particles of {spacing} m"
            ));
        }
        Ok((running, opened))
    });
    let (mut running, opened) = match ranks {
        None => begun?,
        Some(ranks) => all_ready(&*ranks, begun)?,
    };
    let end = scene.run.end;
    let schedule = Schedule {
        end,
        rows: scene.output.series_interval(end),
        next_output: Box::new(move |time| scene.output.next_after(time, end)),
        hits_outputs: true,
        checkpoints: scene.run.checkpoint_interval(),
        max_steps: scene.run.max_steps,
        capped: Status::Interrupted,
        max_wall: scene.run.max_wall,
    };
    opened.drive(&mut running, &schedule, observer)
}

/// A run that has not begun, of a scene that nothing is refused of.
fn ready<'a, const D: usize>(
    scene: &'a Scene,
    options: &'a RunOptions,
    ranks: Option<Arc<dyn Transport>>,
) -> Result<Running<'a, D>> {
    let share = ranked::share(scene, options, ranks.as_ref());
    let mut parts = assembled::<D>(scene, share)?;
    if !parts.flow.is_blank() {
        rehearse(scene, &mut parts.flow, &parts.probes)?;
        let mut limits = parts.flow.step_limits()?;
        parts.flow.least_limits(&mut limits)?;
        let remedies = parts.flow.remedies_of_bounds()?;
        let short = short_steps(scene, &limits, &remedies)?;
        parts.warnings.extend(short);
    }
    readable(scene)?;
    let why = match (&ranks, &options.start) {
        (Some(_), _) => Some("zones run in one process: take `--ranks` out"),
        (_, Start::From(_)) => Some("a run with zones begins at its start: take `--from` out"),
        _ => None,
    };
    if let Some((name, why)) = scene.zone.keys().next().zip(why) {
        return Err(RunError::at(format!("zone.{name}"), why));
    }
    let zones = attach(scene, &parts)?;
    if let Some(ranks) = &ranks {
        refuse_the_indivisible(&parts.flow, ranks.ranks())?;
    }
    Ok(Running {
        scene,
        options,
        ranks,
        whole: None,
        counters: Counters::begin(),
        extrema: Extrema::NONE,
        good: None,
        known: DerivedState::default(),
        tried: (0.0, "none"),
        limits: Vec::new(),
        mach: MachWatch::default(),
        energy: EnergyWatch::from_scene(scene, &parts.flow),
        departure: DepartureWatch::default(),
        shares: Vec::new(),
        around: Nearby::NONE,
        parts,
        zones,
    })
}

/// Adds to the count of a name, which is entered at its first use.
fn count<T: AddAssign + Default>(all: &mut BTreeMap<String, T>, name: &str, more: T) {
    match all.get_mut(name) {
        Some(sum) => *sum += more,
        None => *all.entry(name.to_string()).or_default() += more,
    }
}

impl<const D: usize> Running<'_, D> {
    /// One step from an evaluated state, which is kept, not beyond `target` (s); its failure, if there is one.
    pub fn step(&mut self, target: f64) -> Result<Result<(), StepError>> {
        let time = self.parts.flow.world.time;
        let (dt, limiter) = match self.chosen_step(time, target)? {
            Ok(chosen) => chosen,
            Err(cause) => return Ok(Err(cause)),
        };
        if self.scene.run.retries > 0 {
            let good = self.good.get_or_insert_default();
            good.take(&self.parts.flow)?;
        }
        if let Some(cause) = standing_still(time, dt, target, limiter) {
            return Err(self.failed(cause));
        }
        self.tried = (dt, limiter);
        if let Err(cause) = self.zones.step(&mut self.parts, dt, target) {
            return Ok(Err(cause));
        }
        self.counters.steps += 1;
        count(&mut self.counters.limited, limiter, 1);
        let scale = f64::from_bits(self.counters.step_scale);
        self.counters.step_scale = (scale * RECOVERY).min(1.0).to_bits();
        Ok(Ok(()))
    }

    pub fn evaluate(&mut self) -> Result<(), StepError> {
        let flow = &mut self.parts.flow;
        let bounds = self.scene.numerics.density_bounds;
        let done = self.zones.evaluate(flow);
        let done = done.and_then(|()| guard::rates(&flow.world, &flow.laws, bounds));
        let most = &mut self.counters.stage_bytes;
        most.resize(flow.stages.len(), 0);
        for (most, stage) in most.iter_mut().zip(&flow.stages) {
            *most = stage.bytes().max(*most);
        }
        // No rank goes on to what is done with an evaluated state if another has none.
        self.agreed(done.err()).map_or(Ok(()), Err)
    }

    /// The next step and its limit, noted with all bounds.
    fn chosen_step(
        &mut self,
        time: f64,
        target: f64,
    ) -> Result<Result<(f64, &'static str), StepError>> {
        let mut limits = std::mem::take(&mut self.limits);
        let flow = &mut self.parts.flow;
        flow.step_limits_into(&mut limits)?;
        let chosen = flow.least_limits(&mut limits).map(|()| {
            for limit in limits.iter().filter(|l| l.dt > 0.0) {
                count(&mut self.counters.bounds, limit.name, 1.0 / limit.dt);
            }
            let factor = self.scene.run.safety * f64::from_bits(self.counters.step_scale);
            next_step(&limits, factor, [time, target], self.scene.run.end)
        });
        self.limits = limits;
        Ok(chosen)
    }
}

/// Runs a scene on several ranks that are threads of this process.
///
/// The results are those of one rank, to the bit. Its purpose is to see how a scene divides, without a cluster.
///
/// # Errors
/// As [`run_part`].
pub fn run_on_threads(
    scene: &Scene,
    options: &RunOptions,
    ranks: usize,
    observer: &mut Watch<'_>,
) -> Result<Summary> {
    let cores = std::thread::available_parallelism().map_or(1, usize::from);
    let threads = options.threads.or(Some((cores / ranks).max(1)));
    let options = &options.clone().threads(threads);
    std::thread::scope(|scope| {
        let mut communicator = Thread::communicator(ranks).into_iter();
        let first = communicator.next();
        let part = |rank: Thread| move || run_part(scene, options, Arc::new(rank), &mut ());
        let others: Vec<_> = communicator.map(|rank| scope.spawn(part(rank))).collect();
        let first = match first {
            Some(first) => run_part(scene, options, Arc::new(first), observer),
            None => Err(RunError::at("--ranks", "there must be one at least")),
        };
        for other in others {
            let ended = other.join().unwrap_or_else(|_| Err(panicked()));
            // The first rank has reported it, if it could.
            if first.is_ok() {
                ended?;
            }
        }
        first?.ok_or_else(panicked)
    })
}

fn panicked() -> RunError {
    RunError::at("--ranks", "a rank ended without a result")
}
