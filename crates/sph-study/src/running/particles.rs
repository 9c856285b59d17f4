//! Scenes of particles as what a study runs.

use std::sync::Arc;

use sph_core::SceneProblem;
use sph_io::IoError;
use sph_particles::{RunError, Summary, marks, run};
use sph_run::{Identity, RunOptions, Start, Watch};
use sph_scene::{Diagnostic, Loaded, Source, read};
use sph_setup::examine;
use sph_solver::SolverError;
use toml::Table;

use crate::running::cost::SolveCost;
use crate::running::record::{Health, Record};
use crate::subject::{Ended, Method, Request, Subject};

/// Smoothed particles.
#[derive(Clone, Copy, Debug)]
pub struct Particles;

impl Method for Particles {
    fn quiet(&self) -> &[&str] {
        &["output.vtk=false", "output.picture=[]"]
    }

    fn read(&self, source: Source) -> Result<Arc<dyn Subject>, (Source, Vec<Diagnostic>)> {
        match read(source) {
            Ok(loaded) => Ok(Arc::new(loaded)),
            Err(refused) => Err((refused.source, refused.diagnostics)),
        }
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
        Loaded::resolved(self)
    }

    fn marks(&self) -> Result<Vec<(String, String)>, SceneProblem> {
        let marks = marks(self).map_err(|error| match error {
            SolverError::Scene(problems) => {
                let first = problems.into_iter().next();
                first.unwrap_or_else(|| SceneProblem::new("", ""))
            }
            other => SceneProblem::new("", other.to_string()),
        })?;
        let each = |mark: sph_run::FileMark| (mark.key, mark.content.to_string());
        Ok(marks.into_iter().map(each).collect())
    }

    fn end(&self) -> f64 {
        self.scene.run.end
    }

    /// Pairs in the sweeps of all steps.
    fn assemble(&self) -> Result<f64, Vec<SceneProblem>> {
        match examine(&self.scene) {
            Ok(examined) => Ok(examined.pairs),
            Err(SolverError::Scene(problems)) => Err(problems),
            Err(other) => Err(vec![SceneProblem::new("", other.to_string())]),
        }
    }

    fn run(&self, request: &Request<'_>, observer: &mut Watch<'_>) -> Result<Ended, IoError> {
        let options = RunOptions {
            out: request.out.to_path_buf(),
            start: match request.resume {
                true => Start::Resumed,
                false => Start::Afresh,
            },
            threads: Some(request.threads),
            identity: Identity::of_text(request.identity.to_string()),
        };
        match run(&self.scene, &options, observer) {
            Ok(summary) if summary.status == sph_run::Status::Done => {
                Ok(Ended::Done(Box::new(record(&summary))))
            }
            Ok(summary) => Ok(Ended::Stopped(Box::new(record(&summary)))),
            Err(error) if request.resume && cannot_resume(&error) => Ok(Ended::Unusable),
            Err(RunError::Io(error)) => Err(error),
            Err(error) => Ok(Ended::Failed(Box::new(failed(&error)), error.to_string())),
        }
    }
}

/// What a run gave.
fn record(summary: &Summary) -> Record {
    let errors = summary.errors.iter();
    Record {
        spent: summary.wall_seconds,
        threads: summary.threads,
        particles: summary.particles,
        steps: summary.steps,
        steps_rolled_back: summary.steps_rolled_back,
        simulated_seconds: summary.simulated_seconds,
        dt_limiters: summary.dt_limiters.clone(),
        solves: summary.counted("implicit_viscosity").map(SolveCost::of),
        health: Health::of(summary),
        errors: errors.map(|(name, e)| (name.clone(), e.into())).collect(),
        wall_seconds_by_stage: summary.wall_seconds_by_stage.clone(),
        ..Record::default()
    }
}

/// What a failed run gave.
fn failed(error: &RunError) -> Record {
    let RunError::Failed(failure) = error else {
        return Record::default();
    };
    let mut known = match &failure.summary {
        Some(summary) => record(summary),
        None => {
            let mut known = Record::default();
            known.health.first_trouble = Some(failure.first.clone());
            known
        }
    };
    known.steps = failure.step;
    known.simulated_seconds = failure.time;
    known
}

/// Whether an error says that a checkpoint is of no use, so that the variant starts afresh.
fn cannot_resume(error: &RunError) -> bool {
    match error {
        RunError::Resume { .. } => true,
        RunError::Io(io) => unusable(io),
        _ => false,
    }
}

/// Whether a file is no checkpoint that can be read.
pub fn unusable(error: &IoError) -> bool {
    use IoError::{Checkpoint, Malformed, Read, TooShort};
    matches!(
        error,
        Checkpoint { .. } | Malformed { .. } | Read { .. } | TooShort { .. }
    )
}
