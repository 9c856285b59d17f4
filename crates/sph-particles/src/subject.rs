//! Scenes of particles as subjects of runs, with their identities: the scene and the files that it reads.

use std::sync::Arc;

use serde_json::{Value as Json, json};
use sph_core::SceneProblem;
use sph_io::IoError;
use sph_run::{Ended, Identity, Method, RunOptions, Subject, Watch, marks, unusable};
use sph_scene::{Diagnostic, Loaded, Source, read};
use sph_solver::SolverError;
use toml::Table;

use crate::failure::error::RunError;
use crate::running::run::run;
use crate::setup::examine;

/// Smoothed particles.
#[derive(Clone, Copy, Debug)]
pub struct Particles;

impl Method for Particles {
    fn quiet(&self) -> &[&str] {
        &["output.vtk=false", "output.picture=[]"]
    }

    fn read(&self, source: Source) -> Result<Arc<dyn Subject>, (Source, Vec<Diagnostic>)> {
        match read(source) {
            Ok(loaded) => Ok(Arc::new(Scene(loaded))),
            Err(refused) => Err((refused.source, refused.diagnostics)),
        }
    }
}

/// A scene of particles.
#[derive(Debug)]
struct Scene(Loaded);

impl Subject for Scene {
    fn source(&self) -> &Source {
        &self.0.source
    }

    fn references(&self) -> Vec<String> {
        self.0.scene.reference.keys().cloned().collect()
    }

    fn resolved(&self) -> Table {
        self.0.resolved()
    }

    fn end(&self) -> f64 {
        self.0.scene.run.end
    }

    /// Pairs in the sweeps of all steps.
    fn assemble(&self) -> Result<f64, Vec<SceneProblem>> {
        let examined = examine(&self.0.scene).map_err(problems)?;
        Ok(examined.pairs)
    }

    fn run(&self, options: &RunOptions, observer: &mut Watch<'_>) -> Result<Ended, IoError> {
        let goes_on = options.start.goes_on();
        match run(&self.0.scene, options, observer) {
            Ok(summary) => Ok(Ended::done(summary.status, &summary)),
            // The checkpoint is of no use.
            Err(RunError::Resume { .. }) if goes_on => Ok(Ended::Unusable),
            Err(RunError::Io(error)) if goes_on && unusable(&error) => Ok(Ended::Unusable),
            Err(RunError::Io(error)) => Err(error),
            Err(error) => Ok(Ended::Failed(known(&error), error.to_string())),
        }
    }
}

/// The problems of a scene; of other errors one.
fn problems(error: SolverError) -> Vec<SceneProblem> {
    match error {
        SolverError::Scene(problems) => problems,
        other => vec![SceneProblem::new("", other.to_string())],
    }
}

/// Results of a failed run.
fn known(error: &RunError) -> Json {
    let RunError::Failed(failure) = error else {
        return Json::Null;
    };
    let mut known = match &failure.summary {
        Some(summary) => serde_json::to_value(summary).unwrap_or(Json::Null),
        None => json!({ "first_trouble": failure.first }),
    };
    known["steps"] = failure.findings.cause.step.into();
    known["simulated_seconds"] = failure.findings.cause.time.into();
    known
}

/// That of a scene: its text, its overrides, and the content of every file that it names.
///
/// # Errors
/// A file that cannot be read, at its key.
pub fn identity(loaded: &Loaded) -> Result<Identity, SolverError> {
    let source = &loaded.source;
    let set = source.overrides.iter();
    let set = set.map(|o| format!("\n--set {}", &o.text));
    let text = std::iter::once(source.text().to_string()).chain(set);
    Ok(Identity {
        files: marks(source, &loaded.resolved())?,
        ..Identity::of_text(text.collect::<String>())
    })
}
