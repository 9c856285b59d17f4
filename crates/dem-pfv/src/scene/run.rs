//! Grains as a model that is run.

use std::collections::BTreeMap;
use std::path::Path;
use std::time::Instant;

use sph_run::{
    BAD_STATE, BAD_STATE_PICTURE, Frames, Identity, ModelTime, Outlay, RunCounters, RunOptions,
    SERIES, Schedule, Start, Status, Watch,
};

use crate::coupled::CoupledError;
use crate::scene::assemble::{Assembled, assemble, loads};
use crate::scene::error::{DemError, Failure, named};
use crate::scene::examine::plugins;
use crate::scene::fields::values;
use crate::scene::laws::{Laws, throats};
use crate::scene::measure::{headings, row};
use crate::scene::model::{CheckpointState, Model, Progress, load_checkpoint, save_checkpoint};
use crate::scene::read::Loaded;
use crate::scene::summary::Summary;
use crate::scene::tables::Probe;
use crate::scene::{compare, frames};

/// Version of the form of the summary.
const SCHEMA_VERSION: u32 = 1;

/// Identity of the checkpoints of a scene.
pub fn identity(loaded: &Loaded) -> Identity {
    Identity::of_text(loaded.table.to_string())
}

/// Runs a scene. Nothing is written before its grains are ready.
///
/// # Errors
/// Mistakes of the scene, files that cannot be written, a step that failed.
pub fn run(
    loaded: &Loaded,
    options: &RunOptions,
    observer: &mut Watch<'_>,
) -> Result<Summary, DemError> {
    loaded.check_files()?;
    // Of zero threads as many as there are cores.
    let threads = options.threads.unwrap_or(0);
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
    let pool = pool.map_err(|e| DemError::Threads(threads, e.to_string()))?;
    let (run, output) = (&loaded.scene.run, &loaded.scene.output);
    let schedule = Schedule {
        rows: output.series_interval(run.end),
        hits_outputs: false,
        checkpoints: run.checkpoint_every.unwrap_or(run.end / 10.0),
        max_steps: run.max_steps,
        capped: Status::Done,
        ..Schedule::every(output.interval(run.end), run.end)
    };
    let outlay = Outlay {
        vtk: !output.no_vtk,
        pictures: output.picture.clone(),
        digits: 6,
        animation: Some(output.animation.unwrap_or(10.0)).filter(|speed| *speed > 0.0),
        folders: output.picture.iter().take(1).map(|_| "pictures").collect(),
    };
    pool.install(|| {
        let mut running = Running::new(loaded, options, observer)?;
        let summary = sph_run::run(&mut running, options, &schedule, outlay, observer)?;
        summary.ok_or_else(|| DemError::Resume("there is no summary of the run".into()))
    })
}

struct Running<'a> {
    loaded: &'a Loaded,
    options: &'a RunOptions,
    /// The grains, once they are prepared or come from a checkpoint.
    parts: Option<Assembled>,
    progress: Progress,
    /// Bound that limited the last step.
    limiter: &'static str,
}

impl<'a> Running<'a> {
    fn new(
        loaded: &'a Loaded,
        options: &'a RunOptions,
        observer: &mut Watch<'_>,
    ) -> Result<Self, DemError> {
        let mut running = Running {
            loaded,
            options,
            parts: None,
            progress: Progress::default(),
            limiter: "none",
        };
        if options.start == Start::Afresh {
            let begun = Instant::now();
            running.parts = Some(assemble(loaded, &mut |text| observer.message(text))?);
            let seconds = begun.elapsed().as_secs_f64();
            running.progress.preparation_seconds = seconds;
            running.progress.books.wall_seconds = seconds;
        }
        Ok(running)
    }

    fn parts(&self) -> Result<&Assembled, DemError> {
        let none = || DemError::Resume("there are no grains yet".into());
        self.parts.as_ref().ok_or_else(none)
    }

    /// Grains of a checkpoint, with the laws of the scene.
    fn resume(&mut self, changed: bool, own: &Path) -> Result<(), DemError> {
        let scene = &self.loaded.scene;
        let kept = load_checkpoint(&self.options.identity.scene, changed, own)?;
        let laws = Laws::from_scene(scene)?.all;
        let model = Model::resume(kept.model, laws, throats(scene)?);
        self.parts = Some(Assembled {
            model: model.map_err(|e| DemError::Resume(e.to_string()))?,
            origin: kept.origin,
            loads: loads(scene),
        });
        self.progress = kept.progress;
        Ok(())
    }

    fn now(&self) -> Result<ModelTime, DemError> {
        let grains = self.parts()?.model.grains();
        Ok(ModelTime {
            time: grains.time,
            steps: grains.steps,
            dt: self.progress.dt,
            limiter: self.limiter,
            size: grains.grains.len(),
        })
    }
}

impl sph_run::Model for Running<'_> {
    type Error = DemError;
    type Summary = Summary;

    fn begin(
        &mut self,
        start: &Start,
        own: &Path,
        _: &mut Watch<'_>,
    ) -> Result<RunCounters, DemError> {
        match start {
            Start::Afresh => {}
            Start::Resumed | Start::Changed => self.resume(*start == Start::Changed, own)?,
            Start::From(_) => {
                let why = "grains go on from the checkpoint of their own run alone";
                return Err(DemError::Resume(why.into()));
            }
        }
        let mut probes = self.loaded.scene.probe.values();
        if let Some(parts) = &mut self.parts
            && probes.any(|p| matches!(p, Probe::Flux { .. }))
        {
            parts.model.measure_inflow();
        }
        Ok(self.progress.books.clone())
    }

    fn advance(&mut self, limit: f64, _: &mut Watch<'_>) -> Result<ModelTime, DemError> {
        let before = self.now()?;
        if let Some(parts) = self.parts.as_mut().filter(|_| before.time < limit) {
            parts.model.apply(&parts.loads);
            let made = parts.model.advance(self.loaded.scene.run.safety, limit)?;
            self.progress.dt = made.step;
            self.limiter = made.limiter;
            let limited = self.progress.limited.entry(made.limiter.to_string());
            *limited.or_default() += 1;
        }
        self.now()
    }

    fn columns(&self) -> Vec<(String, String)> {
        headings(&self.loaded.scene)
    }

    fn row(&mut self, _: &mut Watch<'_>) -> Result<Vec<f64>, DemError> {
        let Assembled { model, origin, .. } = self.parts()?;
        let dt = self.progress.dt;
        Ok(row(&self.loaded.scene, model, origin, dt))
    }

    fn show(
        &mut self,
        frames: Option<&mut Frames>,
        observer: &mut Watch<'_>,
    ) -> Result<(), DemError> {
        let Assembled { model, origin, .. } = self.parts()?;
        let (time, scene) = (model.grains().time, &self.loaded.scene);
        if let Some(frames) = frames {
            if frames.lists() {
                frames.add(time, frames::pieces(model, origin), 1)?;
            }
            for field in &scene.output.picture {
                let range = scene.output.picture_range.as_ref();
                let given = range.and_then(|all| all.ends(field));
                let range = given.or_else(|| {
                    let seen = frames.colours.next(field, &values(field, model, origin))?;
                    if seen.1 {
                        observer.message(&format!(
                            "note: the range of colours of `{field}` is wider from t = {time:.4} s on; \
                             `output.picture_range` fixes it"
                        ));
                    }
                    Some(seen.0)
                });
                let path = frames.picture(field);
                frames::picture(model, origin, field, range, &scene.title, None, &path)?;
            }
        }
        Ok(())
    }

    fn save(&mut self, books: &RunCounters, own: &Path) -> Result<(), DemError> {
        self.progress.books = books.clone();
        let parts = self.parts()?;
        let kept = CheckpointState {
            model: parts.model.save(),
            origin: parts.origin.clone(),
            progress: self.progress.clone(),
        };
        save_checkpoint(kept, &self.options.identity.scene, own)
    }

    fn conclude(
        &mut self,
        ended: Result<Status, &mut DemError>,
        books: &RunCounters,
        observer: &mut Watch<'_>,
    ) -> Result<Option<Summary>, DemError> {
        match ended {
            Ok(status) => self.summary(status, Vec::new(), books).map(Some),
            Err(DemError::Failed(failure)) => {
                self.draw_the_bad_state(failure, observer)?;
                let warnings = vec![failure.to_string()];
                self.summary(Status::Failed, warnings, books).map(Some)
            }
            Err(_) => Ok(None),
        }
    }
}

impl Running<'_> {
    /// The last state in files, and a picture with the grain at fault, which the failure then names.
    fn draw_the_bad_state(
        &self,
        failure: &mut Failure,
        observer: &mut Watch<'_>,
    ) -> Result<(), DemError> {
        if let CoupledError::Grains(error) = &failure.error {
            failure.named = named(self.loaded, error);
        }
        let Assembled { model, origin, .. } = self.parts()?;
        let out = &self.options.out;
        let title = format!("{}: failed", self.loaded.scene.title);
        let drawn = frames::picture(
            model,
            origin,
            "speed",
            None,
            &title,
            failure.position,
            &out.join(BAD_STATE_PICTURE),
        );
        let spheres = frames::pieces(model, origin).into_iter().next();
        let saved = spheres.map_or(Ok(()), |piece| {
            let time = model.grains().time;
            Ok(sph_io::write_vtu(out.join(BAD_STATE), &piece, time)?)
        });
        // The failure itself matters more than an error of writing about it.
        for problem in [drawn, saved].into_iter().filter_map(Result::err) {
            observer.message(&format!("note: {problem}"));
        }
        Ok(())
    }

    fn summary(
        &self,
        status: Status,
        warnings: Vec<String>,
        books: &RunCounters,
    ) -> Result<Summary, DemError> {
        let parts = self.parts()?;
        let model = &parts.model;
        let grains = model.grains();
        let steps = grains.steps;
        let wall = books.wall_seconds;
        let stepping = wall - self.progress.preparation_seconds;
        let count = grains.grains.len();
        let limited = self.progress.limited.iter();
        let errors = match status {
            Status::Failed => BTreeMap::new(),
            _ => compare::errors(self.loaded, &parts.origin, &self.options.out.join(SERIES))?,
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
            simulated_seconds: grains.time,
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
            derived: derived(parts),
            errors,
            warnings,
        })
    }
}

/// Measurements before the run.
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
