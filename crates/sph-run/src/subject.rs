//! Scenes that can be run, by any method.

use std::fmt::Debug;
use std::sync::Arc;

use scene_text::{Diagnostic, SceneProblem, Source};
use serde::Serialize;
use serde_json::Value as Json;
use sph_io::IoError;
use toml::Table;

use crate::model::{Status, Watch};
use crate::options::RunOptions;

/// A way to compute scenes.
pub trait Method: Debug + Sync {
    /// Scene values that keep a variant from writing files that are not read, as `--set` has them.
    fn quiet(&self) -> &[&str];

    /// A valid scene.
    ///
    /// # Errors
    /// Every mistake found, with the text that it stands in.
    fn read(&self, source: Source) -> Result<Arc<dyn Subject>, (Source, Vec<Diagnostic>)>;
}

/// A valid scene that can be run.
pub trait Subject: Debug + Send + Sync {
    /// Its text.
    fn source(&self) -> &Source;

    /// Names of the references that it is compared with.
    fn references(&self) -> Vec<String>;

    /// The scene as a table, quantities in SI: two scenes with the same table are the same.
    fn resolved(&self) -> Table;

    /// Simulated time at the end, s.
    fn end(&self) -> f64;

    /// Puts it together as a run would; returns the work of a run, in a measure that is the same for all scenes of the method.
    ///
    /// # Errors
    /// Everything its plugins refuse.
    fn assemble(&self) -> Result<f64, Vec<SceneProblem>>;

    /// Runs it, telling an observer of every step.
    ///
    /// # Errors
    /// A file that cannot be written, which is no fault of the scene.
    fn run(&self, options: &RunOptions, observer: &mut Watch<'_>) -> Result<Ended, IoError>;
}

/// End of a run, with its summary.
#[derive(Debug)]
pub enum Ended {
    /// It reached its end.
    Done(Json),
    /// It was stopped, by its observer or a bound of its own.
    Stopped(Json),
    /// It failed, for this reason; as much of the summary as is known.
    Failed(Json, String),
    /// The checkpoint that it was to go on from is of no use.
    Unusable,
}

impl Ended {
    /// Of a run that ended well.
    pub fn done(status: Status, summary: &impl Serialize) -> Self {
        let summary = serde_json::to_value(summary).unwrap_or(Json::Null);
        match status {
            Status::Done => Ended::Done(summary),
            _ => Ended::Stopped(summary),
        }
    }
}

/// True if a file is no checkpoint that can be read.
pub fn unusable(error: &IoError) -> bool {
    use IoError::{Checkpoint, Malformed, Read, TooShort};
    matches!(
        error,
        Checkpoint(..) | Malformed(..) | Read(..) | TooShort { .. }
    )
}
