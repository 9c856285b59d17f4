//! Scenes of grains as what a study runs.

use std::sync::Arc;

use dem_scene::{Compared, DemError, Loaded, Summary, run};
use sph_core::SceneProblem;
use sph_io::IoError;
use sph_run::{Identity, RunOptions, Start, Status, Watch};
use sph_scene::{Diagnostic, Source};
use sph_study::{Ended, Method, Record, Request, Subject, unusable};
use toml::{Table, Value};

/// Longest file that a scene may name, bytes.
const LONGEST: u64 = 512 << 20;

/// Discrete elements, with or without a fluid in their pores.
#[derive(Clone, Copy, Debug)]
pub struct Grains;

impl Method for Grains {
    fn quiet(&self) -> &[&str] {
        &["output.no_vtk=true", "output.picture=[]"]
    }

    fn read(&self, source: Source) -> Result<Arc<dyn Subject>, (Source, Vec<Diagnostic>)> {
        Ok(Arc::new(Scene(dem_scene::read(source)?)))
    }
}

/// A scene of grains.
#[derive(Debug)]
struct Scene(Loaded);

impl Subject for Scene {
    fn source(&self) -> &Source {
        &self.0.source
    }

    fn references(&self) -> Vec<String> {
        self.0.references.keys().cloned().collect()
    }

    fn resolved(&self) -> Table {
        self.0.table.clone()
    }

    fn marks(&self) -> Result<Vec<(String, String)>, SceneProblem> {
        let mark = |(key, file): (String, String)| {
            let told = |why: String| SceneProblem::new(key.clone(), why);
            let path = self.0.source.resolve(&key, &file);
            let path = path.map_err(|e| told(e.to_string()))?;
            let content = sph_io::checksum(&path, LONGEST);
            let content = content.map_err(|e| told(e.to_string()))?;
            Ok((key, content.to_string()))
        };
        self.0.files().into_iter().map(mark).collect()
    }

    fn end(&self) -> f64 {
        self.0.scene.run.end
    }

    /// Grains times simulated seconds.
    fn assemble(&self) -> Result<f64, Vec<SceneProblem>> {
        match dem_scene::examine(&self.0) {
            Ok(examined) => Ok(examined.grains.unwrap_or(1) as f64 * self.end()),
            Err(DemError::Scene(problems)) => Err(problems),
            Err(other) => Err(vec![SceneProblem::new("", other.to_string())]),
        }
    }

    fn run(&self, request: &Request<'_>, observer: &mut Watch<'_>) -> Result<Ended, IoError> {
        // A checkpoint holds the table of its scene: so those of another run are not gone on from.
        let mut known = self.0.table.clone();
        let own = Value::String(request.identity.to_string());
        known.insert("study".into(), own);
        let options = RunOptions {
            out: request.out.to_path_buf(),
            start: match request.resume {
                true => Start::Resumed,
                false => Start::Afresh,
            },
            threads: Some(request.threads),
            identity: Identity::of_text(known.to_string()),
        };
        match run(&self.0, &options, observer) {
            Ok(summary) if summary.status == Status::Done => {
                Ok(Ended::Done(Box::new(record(&summary))))
            }
            Ok(summary) => Ok(Ended::Stopped(Box::new(record(&summary)))),
            Err(DemError::Resume(_)) if request.resume => Ok(Ended::Unusable),
            Err(DemError::Io(error)) if request.resume && unusable(&error) => Ok(Ended::Unusable),
            Err(DemError::Io(error)) => Err(error),
            Err(error) => {
                let mut known = Record::default();
                if let DemError::Failed(failure) = &error {
                    known.steps = failure.step;
                    known.simulated_seconds = failure.time;
                }
                Ok(Ended::Failed(Box::new(known), error.to_string()))
            }
        }
    }
}

/// What a run gave. Particles are grains.
fn record(summary: &Summary) -> Record {
    let error = |(name, found): (&String, &Compared)| {
        let error = sph_study::Error {
            value: found.value,
            norm: found.norm.clone(),
            unit: "1".into(),
        };
        (name.clone(), error)
    };
    Record {
        spent: summary.wall_seconds,
        threads: summary.threads,
        particles: summary.grains,
        steps: summary.steps,
        simulated_seconds: summary.simulated_seconds,
        dt_limiters: summary.dt_limiters.clone(),
        errors: summary.errors.iter().map(error).collect(),
        ..Record::default()
    }
}
