//! A run: prepared or resumed, stepped, measured, written.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::time::Instant;

use dem_coupled::CoupledError;

use crate::assemble::{Assembled, assemble, loads};
use crate::at_fault;
use crate::checkpoint::{self, Kept, Progress};
use crate::compare;
use crate::error::{DemError, Failure};
use crate::examine::plugins;
use crate::frames;
use crate::laws::{Laws, throats};
use crate::model::Model;
use crate::read::Loaded;
use crate::summary::{Status, Summary};
use crate::tables::Probe;
use crate::written::Written;

/// Where a run begins.
#[derive(Clone, Copy, Debug, Eq, PartialEq)]
pub enum Start {
    /// At the beginning.
    Afresh,
    /// At the checkpoint in its folder, of the same scene.
    Resumed,
    /// At the checkpoint in its folder, whatever has changed in the scene.
    Changed,
}

/// How a scene is run.
#[derive(Clone, Debug)]
pub struct RunOptions {
    /// Folder of the results.
    pub out: PathBuf,
    /// Where it begins.
    pub start: Start,
    /// Threads; all cores if none are given.
    pub threads: Option<usize>,
}

/// Where a run is.
#[derive(Clone, Copy, Debug)]
pub struct Step {
    /// Simulated time, s.
    pub time: f64,
    /// Simulated time at the end, s.
    pub end: f64,
    /// Steps made.
    pub step: u64,
    /// The last step, s.
    pub dt: f64,
    /// What limited it.
    pub limiter: &'static str,
    /// Grains.
    pub grains: usize,
}

/// Who watches a run.
pub trait Observer {
    /// After every step; false stops the run with a checkpoint.
    fn step(&mut self, step: &Step) -> bool;
    /// A line worth saying.
    fn message(&mut self, text: &str);
}

impl Observer for () {
    fn step(&mut self, _: &Step) -> bool {
        true
    }
    fn message(&mut self, _: &str) {}
}

/// Name of the summary in a run's folder.
pub const SUMMARY: &str = "summary.json";
/// Version of the form of the summary.
const SCHEMA_VERSION: u32 = 1;

/// Runs a scene. Nothing is written before its grains are ready.
///
/// # Errors
/// Mistakes of the scene, files that cannot be written, a step that failed.
pub fn run(
    loaded: &Loaded,
    options: &RunOptions,
    observer: &mut (dyn Observer + Send),
) -> Result<Summary, DemError> {
    loaded.check_files()?;
    let mut pool = rayon::ThreadPoolBuilder::new();
    if let Some(threads) = options.threads {
        pool = pool.num_threads(threads);
    }
    let pool = pool.build().map_err(|e| DemError::Threads {
        threads: options.threads.unwrap_or(0),
        reason: e.to_string(),
    })?;
    pool.install(|| Running::new(loaded, options, observer)?.run_to_end())
}

struct Running<'a> {
    loaded: &'a Loaded,
    out: &'a Path,
    observer: &'a mut (dyn Observer + Send),
    parts: Assembled,
    progress: Progress,
    written: Written,
    identity: String,
    begun: Instant,
    _lock: sph_io::FolderLock,
}

impl<'a> Running<'a> {
    fn new(
        loaded: &'a Loaded,
        options: &'a RunOptions,
        observer: &'a mut (dyn Observer + Send),
    ) -> Result<Self, DemError> {
        let begun = Instant::now();
        let out = options.out.as_path();
        let identity = loaded.table.to_string();
        let (mut parts, progress) = match options.start {
            Start::Afresh => {
                let parts = assemble(loaded, &mut |text| observer.message(text))?;
                let preparation_seconds = begun.elapsed().as_secs_f64();
                let progress = Progress {
                    preparation_seconds,
                    ..Progress::default()
                };
                (parts, progress)
            }
            start => resumed(loaded, out, &identity, start == Start::Changed)?,
        };
        if loaded
            .probes
            .values()
            .any(|p| matches!(p, Probe::Flux { .. }))
        {
            parts.model.measure_inflow();
        }
        sph_io::writable(out)?;
        let lock = sph_io::FolderLock::take(out)?;
        sph_io::sweep_temporaries(out)?;
        let afresh = options.start == Start::Afresh;
        let written = Written::new(loaded, out, if afresh { None } else { Some(&progress) })?;
        Ok(Self {
            loaded,
            out,
            observer,
            parts,
            progress,
            written,
            identity,
            begun,
            _lock: lock,
        })
    }

    fn run_to_end(mut self) -> Result<Summary, DemError> {
        let run = &self.loaded.scene.run;
        let end = run.end;
        self.write_due()?;
        let most = run.max_steps.unwrap_or(u64::MAX);
        let mut interrupted = false;
        while self.parts.model.grains().time() < end && self.parts.model.grains().steps() < most {
            self.parts.model.apply(&self.parts.loads);
            let made = match self.parts.model.advance(run.safety, end) {
                Ok(made) => made,
                Err(failure) => return Err(self.failed(failure)),
            };
            self.progress.dt = made.step;
            *self
                .progress
                .limited
                .entry(made.limiter.to_string())
                .or_default() += 1;
            self.write_due()?;
            let grains = self.parts.model.grains();
            let step = Step {
                time: grains.time(),
                end,
                step: grains.steps(),
                dt: made.step,
                limiter: made.limiter,
                grains: grains.grains().len(),
            };
            if !self.observer.step(&step) {
                interrupted = true;
                break;
            }
        }
        self.checkpoint()?;
        self.written.film(self.loaded)?;
        let status = if interrupted {
            Status::Interrupted
        } else {
            Status::Done
        };
        let summary = self.summary(status, Vec::new())?;
        sph_io::write_json(self.out.join(SUMMARY), &summary)?;
        Ok(summary)
    }

    /// Rows, frames and checkpoints whose time has come. Steps are not shortened for them.
    fn write_due(&mut self) -> Result<(), DemError> {
        let scene = &self.loaded.scene;
        let (time, end) = (self.parts.model.grains().time(), scene.run.end);
        let due = |count: u64, every: f64| time >= count as f64 * every || time >= end;
        let later = |last: Option<f64>| last.is_none_or(|last| time > last);
        let rows = due(self.progress.rows, scene.output.series_interval(end));
        if rows && later(self.progress.last_row) {
            let row = crate::columns::row(
                self.loaded,
                &self.parts.model,
                &self.parts.origin,
                self.progress.dt,
            );
            self.progress.series = self.written.row(&row)?;
            self.progress.rows = next(time, scene.output.series_interval(end));
            self.progress.last_row = Some(time);
        }
        let fields = due(self.progress.outputs, scene.output.interval(end));
        if fields && later(self.progress.last_output) {
            let (model, origin) = (&self.parts.model, &self.parts.origin);
            let (frames, wider) = self.written.frame(self.loaded, model, origin)?;
            for field in wider {
                self.observer.message(&format!(
                    "note: the range of colours of `{field}` is wider from t = {time:.4} s on; `output.picture_range` fixes it"
                ));
            }
            self.progress.frames = frames;
            self.progress.colours = self.written.colours.clone();
            self.progress.outputs = next(time, scene.output.interval(end));
            self.progress.last_output = Some(time);
        }
        let every = scene.run.checkpoint_every.unwrap_or(end / 10.0);
        if time < end && time > 0.0 && due(self.progress.checkpoints.max(1), every) {
            self.progress.checkpoints = next(time, every);
            self.checkpoint()?;
        }
        Ok(())
    }

    fn checkpoint(&mut self) -> Result<(), DemError> {
        let mut progress = self.progress.clone();
        progress.wall_seconds += self.begun.elapsed().as_secs_f64();
        let kept = Kept {
            model: self.parts.model.save(),
            origin: self.parts.origin.clone(),
            progress,
        };
        checkpoint::save(&kept, &self.identity, &self.out.join(checkpoint::FILE))
    }

    /// What a failed step leaves: the last state in files, a picture with the grain at fault, the summary.
    fn failed(&mut self, mut failure: Box<Failure>) -> DemError {
        if let CoupledError::Grains(error) = &failure.error {
            failure.named = at_fault::named(self.loaded, error);
        }
        let warnings = vec![failure.to_string()];
        let (model, origin) = (&self.parts.model, &self.parts.origin);
        let title = format!("{}: failed", self.loaded.scene.title);
        let picture = self.out.join("bad_state.png");
        let drawn = frames::picture(
            model,
            origin,
            "speed",
            None,
            &title,
            failure.position,
            &picture,
        );
        let time = model.grains().time();
        let spheres = frames::pieces(model, origin).into_iter().next();
        let saved =
            spheres.map(|piece| sph_io::write_vtu(self.out.join("bad_state.vtu"), &piece, time));
        let told = self
            .summary(Status::Failed, warnings)
            .and_then(|summary| Ok(sph_io::write_json(self.out.join(SUMMARY), &summary)?));
        // The failure itself matters more than what could not be written about it.
        for problem in [drawn.err(), told.err()].into_iter().flatten() {
            self.observer.message(&format!("note: {problem}"));
        }
        if let Some(Err(problem)) = saved {
            self.observer.message(&format!("note: {problem}"));
        }
        failure.into()
    }

    fn summary(&self, status: Status, warnings: Vec<String>) -> Result<Summary, DemError> {
        let model = &self.parts.model;
        let grains = model.grains();
        let steps = grains.steps();
        let wall = self.progress.wall_seconds + self.begun.elapsed().as_secs_f64();
        let stepping = wall - self.progress.preparation_seconds;
        let count = grains.grains().len();
        let limited = self.progress.limited.iter();
        let errors = match status {
            Status::Failed => BTreeMap::new(),
            _ => compare::errors(self.loaded, &self.parts.origin, self.written.series())?,
        };
        let finite = |x: f64| x.is_finite().then_some(x);
        Ok(Summary {
            schema_version: SCHEMA_VERSION,
            scene: self.loaded.scene.title.clone(),
            method: "grains",
            status,
            version: env!("CARGO_PKG_VERSION"),
            plugins: plugins(&self.loaded.scene),
            grains: count,
            cells: model.wet().map(|w| w.pressures().len()),
            meshes: model.wet().map(|w| w.meshes()),
            coordination: grains.coordination(),
            porosity: grains.porosity(),
            unbalanced_force: finite(grains.unbalanced_force()),
            steps,
            simulated_seconds: grains.time(),
            wall_seconds: wall,
            preparation_seconds: self.progress.preparation_seconds,
            threads: rayon::current_num_threads(),
            grain_steps_per_second: if stepping > 0.0 {
                count as f64 * steps as f64 / stepping
            } else {
                0.0
            },
            dt_limiters: limited
                .map(|(name, n)| (name.clone(), *n as f64 / steps.max(1) as f64))
                .collect(),
            derived: derived(&self.parts),
            errors,
            warnings,
        })
    }
}

/// How many intervals have begun by now: the number of the next one.
fn next(time: f64, every: f64) -> u64 {
    (time / every).floor() as u64 + 1
}

/// What was measured before the run.
fn derived(parts: &Assembled) -> BTreeMap<String, f64> {
    let origin = &parts.origin;
    let all = [
        ("mean diameter [m]", Some(origin.diameter)),
        ("highest grain at the start [m]", Some(origin.top)),
        ("load [Pa]", origin.load),
        ("dry strain", origin.dry_strain),
        ("mobility [m²/(Pa s)]", origin.mobility),
        (
            "oedometric modulus [Pa]",
            origin.load.zip(origin.dry_strain).map(|(l, e)| l / e),
        ),
        ("consolidation coefficient [m²/s]", origin.consolidation()),
    ];
    let known = all
        .into_iter()
        .filter_map(|(name, value)| Some((name.to_string(), value?)));
    known.collect()
}

fn resumed(
    loaded: &Loaded,
    out: &Path,
    identity: &str,
    changed: bool,
) -> Result<(Assembled, Progress), DemError> {
    let scene = &loaded.scene;
    let kept = checkpoint::load(identity, changed, &out.join(checkpoint::FILE))?;
    let laws = Laws::of(scene)?.all;
    let model = Model::resume(kept.model, laws, throats(scene)?);
    let model = model.map_err(|e| DemError::Resume(e.to_string()))?;
    let parts = Assembled {
        model,
        origin: kept.origin,
        loads: loads(scene),
    };
    Ok((parts, kept.progress))
}
