//! Scenes of grains as subjects of runs.

use std::sync::Arc;

use scene_text::{Diagnostic, SceneProblem, Source};
use serde_json::{Value as Json, json};
use sph_io::IoError;
use sph_run::{Ended, Identity, Method, RunOptions, Subject, Watch, unusable};
use toml::{Table, Value};

use crate::scene::error::DemError;
use crate::scene::examine::examine;
use crate::scene::read::{Loaded, read};
use crate::scene::run::run;

/// Longest file that a scene may name, bytes.
const LONGEST: u64 = 512 << 20;

/// Discrete elements, with or without a fluid in their pores.
#[derive(Clone, Copy, Debug)]
pub struct DiscreteElements;

impl Method for DiscreteElements {
    fn quiet(&self) -> &[&str] {
        &["output.no_vtk=true", "output.picture=[]"]
    }

    fn read(&self, source: Source) -> Result<Arc<dyn Subject>, (Source, Vec<Diagnostic>)> {
        Ok(Arc::new(Scene(read(source)?)))
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
        self.0.scene.reference.keys().cloned().collect()
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
        match examine(&self.0) {
            Ok(examined) => Ok(examined.grains.unwrap_or(1) as f64 * self.end()),
            Err(DemError::Scene(problems)) => Err(problems),
            Err(other) => Err(vec![SceneProblem::new("", other.to_string())]),
        }
    }

    fn run(&self, options: &RunOptions, observer: &mut Watch<'_>) -> Result<Ended, IoError> {
        // The identity that a study gives the run is added to the scene.
        let mut known = self.0.table.clone();
        let own = Value::String(options.identity.scene.clone());
        known.insert("study".into(), own);
        let mut options = options.clone();
        options.identity = Identity::of_text(known.to_string());
        let resumed = options.start.goes_on();
        match run(&self.0, &options, observer) {
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
