//! Grains as a model that is run.

use std::collections::BTreeMap;
use std::path::Path;
use std::sync::Arc;
use std::time::Instant;

use scene_text::{Diagnostic, SceneProblem, Source};
use serde_json::{Value as Json, json};
use sph_io::IoError;
use sph_run::{
    BAD_STATE, BAD_STATE_PICTURE, Ended, Frames, Identity, Method, Outlay, RunCounters, RunOptions,
    SERIES, SavedState, Schedule, Start, Status, Subject, Watch, save_state, unusable,
};
use toml::Table;

use crate::coupled::CoupledError;
use crate::scene::{
    Assembled, CheckpointState, DemError, Failure, Laws, Loaded, Model, Probe, Progress, Summary,
    assemble, compare, examine, frames, headings, loads, named, read, row, throats, values,
};

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
        rows: output.series_every.unwrap_or(run.end / 500.0),
        hits_outputs: false,
        checkpoints: run.checkpoint_every.unwrap_or(run.end / 10.0),
        max_steps: run.max_steps,
        capped: Status::Done,
        ..Schedule::every(output.every.unwrap_or(run.end / 20.0), run.end)
    };
    let outlay = Outlay {
        vtk: !output.no_vtk,
        pictures: output.picture.clone(),
        digits: 6,
        animation: Some(output.animation.unwrap_or(10.0)).filter(|speed| *speed > 0.0),
        folders: output.picture.iter().take(1).map(|_| "pictures").collect(),
    };
    pool.install(|| {
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

impl Running<'_> {
    fn parts(&self) -> Result<&Assembled, DemError> {
        let none = || DemError::Resume("there are no grains yet".into());
        self.parts.as_ref().ok_or_else(none)
    }

    /// Grains of a checkpoint, with the laws of the scene; with `changed` also one of another scene.
    fn resume(&mut self, changed: bool, own: &Path) -> Result<(), DemError> {
        let scene = &self.loaded.scene;
        let saved = SavedState::load(own)?;
        let refused = |why: &str| DemError::Resume(format!("{}: {why}", own.display()));
        if saved.meta["method"] != "grains" {
            return Err(refused("it is the checkpoint of a scene of particles"));
        }
        if saved.meta["scene"] != self.options.identity.scene && !changed {
            return Err(refused(
                "the scene has changed since; --changed goes on all the same, or start without --resume",
            ));
        }
        let kept: CheckpointState = saved.state().map_err(|e| refused(&e))?;
        let seconds = |name: &str| saved.meta[name].as_f64().unwrap_or_default();
        let laws = Laws::from_scene(scene)?.all;
        let model = Model::resume(kept.model, laws, throats(scene)?);
        self.parts = Some(Assembled {
            model: model.map_err(|e| DemError::Resume(e.to_string()))?,
            origin: kept.origin,
        });
        self.progress = kept.progress;
        self.progress.books.wall_seconds = seconds("wall_seconds");
        self.progress.preparation_seconds = seconds("preparation_seconds");
        Ok(())
    }

    fn now(&self) -> Result<sph_run::Progress, DemError> {
        let grains = self.parts()?.model.grains();
        Ok(sph_run::Progress {
            time: grains.time,
            step: grains.steps,
            dt: self.progress.dt,
            limiter: self.limiter,
            particles: grains.grains.len(),
            ..Default::default()
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
        if let Some(Model::Wet(system)) = self.parts.as_mut().map(|parts| &mut parts.model)
            && probes.any(|p| matches!(p, Probe::Flux { .. }))
        {
            system.measure_inflow();
        }
        Ok(self.progress.books.clone())
    }

    fn advance(&mut self, limit: f64, _: &mut Watch<'_>) -> Result<sph_run::Progress, DemError> {
        let before = self.now()?;
        if let Some(parts) = self.parts.as_mut().filter(|_| before.time < limit) {
            parts.model.apply(loads(&self.loaded.scene));
            let made = parts.model.advance(self.loaded.scene.run.safety, limit)?;
            (self.progress.dt, self.limiter) = made;
            let limited = self.progress.limited.entry(self.limiter.to_string());
            *limited.or_default() += 1;
        }
        self.now()
    }

    fn columns(&self) -> Vec<(String, String)> {
        headings(&self.loaded.scene)
    }

    fn row(&mut self, _: &mut Watch<'_>) -> Result<Vec<f64>, DemError> {
        let Assembled { model, origin } = self.parts()?;
        let dt = self.progress.dt;
        Ok(row(&self.loaded.scene, model, origin, dt))
    }

    fn show(
        &mut self,
        frames: Option<&mut Frames>,
        observer: &mut Watch<'_>,
    ) -> Result<(), DemError> {
        let Assembled { model, origin } = self.parts()?;
        let (time, scene) = (model.grains().time, &self.loaded.scene);
        if let Some(frames) = frames {
            if frames.lists() {
                frames.add(time, frames::pieces(model, origin), 1)?;
            }
            for field in &scene.output.picture {
                let given = scene.output.picture_range.as_ref();
                let range = given.and_then(|all| all.ends(field)).or_else(|| {
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
        let mut kept = CheckpointState {
            model: parts.model.save(),
            origin: parts.origin.clone(),
            progress: self.progress.clone(),
        };
        let meta = json!({
            "method": "grains",
            "scene": self.options.identity.scene,
            "wall_seconds": std::mem::take(&mut kept.progress.books.wall_seconds),
            "preparation_seconds": kept.progress.preparation_seconds,
        });
        Ok(save_state(own, meta, &kept)?)
    }

    fn conclude(
        &mut self,
        ended: Result<Status, &mut DemError>,
        books: &RunCounters,
        observer: &mut Watch<'_>,
    ) -> Result<Option<Summary>, DemError> {
        let (errors, warnings, status) = match ended {
            Ok(status) => {
                let series = self.options.out.join(SERIES);
                let errors = compare::errors(self.loaded, &self.parts()?.origin, &series)?;
                (errors, Vec::new(), status)
            }
            Err(DemError::Failed(failure)) => {
                self.draw_the_bad_state(failure, observer)?;
                (BTreeMap::new(), vec![failure.to_string()], Status::Failed)
            }
            Err(_) => return Ok(None),
        };
        let (scene, parts) = (&self.loaded.scene, self.parts()?);
        let mut summary = Summary::new(scene, parts, &self.progress, status, books);
        (summary.errors, summary.warnings) = (errors, warnings);
        Ok(Some(summary))
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
        let Assembled { model, origin } = self.parts()?;
        let out = &self.options.out;
        let title = format!("{}: failed", self.loaded.scene.title);
        let (at, path) = (failure.position, out.join(BAD_STATE_PICTURE));
        let drawn = frames::picture(model, origin, "speed", None, &title, at, &path);
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
}

/// Discrete elements, with or without a fluid in their pores.
#[derive(Clone, Copy, Debug)]
pub struct DiscreteElements;

impl Method for DiscreteElements {
    fn quiet(&self) -> &[&str] {
        &["output.no_vtk=true", "output.picture=[]"]
    }

    fn read(&self, source: Source) -> Result<Arc<dyn Subject>, (Source, Vec<Diagnostic>)> {
        Ok(Arc::new(read(source)?))
    }
}

impl Subject for Loaded {
    fn source(&self) -> &Source {
        &self.source
    }

    fn references(&self) -> Vec<String> {
        self.scene.reference.keys().cloned().collect()
    }

    fn resolved(&self) -> Table {
        self.table.clone()
    }

    fn end(&self) -> f64 {
        self.scene.run.end
    }

    /// Grains times simulated seconds.
    fn assemble(&self) -> Result<f64, Vec<SceneProblem>> {
        match examine(self) {
            Ok(examined) => Ok(examined.grains.unwrap_or(1) as f64 * self.end()),
            Err(DemError::Scene(problems)) => Err(problems),
            Err(other) => Err(vec![SceneProblem::new("", other.to_string())]),
        }
    }

    fn run(&self, options: &RunOptions, observer: &mut Watch<'_>) -> Result<Ended, IoError> {
        // The identity that a study gives the run is added to the scene.
        let mut known = self.table.clone();
        known.insert("study".into(), options.identity.scene.clone().into());
        let mut options = options.clone();
        options.identity = Identity::of_text(known.to_string());
        let resumed = options.start.goes_on();
        match run(self, &options, observer) {
            Ok(summary) => Ok(Ended::done(summary.status, &summary)),
            Err(DemError::Resume(_)) if resumed => Ok(Ended::Unusable),
            Err(DemError::Io(error)) if resumed && unusable(&error) => Ok(Ended::Unusable),
            Err(DemError::Io(error)) => Err(error),
            Err(error) => {
                let known = match &error {
                    DemError::Failed(failure) => {
                        json!({ "steps": failure.step, "simulated_seconds": failure.time })
                    }
                    _ => Json::Null,
                };
                Ok(Ended::Failed(known, error.to_string()))
            }
        }
    }
}
