//! What a study runs: scenes of particles, or of another method that the program brings along.

use std::fmt::Debug;
use std::path::Path;
use std::sync::Arc;

use sph_core::SceneProblem;
use sph_io::IoError;
use sph_run::Watch;
use sph_scene::{Diagnostic, Source};
use toml::Table;

use crate::running::record::Record;

/// A way to compute scenes.
pub trait Method: Debug + Sync {
    /// Scene values that keep a variant from writing what nobody looks at, as `--set` has them.
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

    /// Every file that it names: the key, and a short text that changes with the content.
    ///
    /// # Errors
    /// A file that cannot be read, at its key.
    fn marks(&self) -> Result<Vec<(String, String)>, SceneProblem>;

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
    fn run(&self, request: &Request<'_>, observer: &mut Watch<'_>) -> Result<Ended, IoError>;
}

/// How a scene is to be run.
#[derive(Clone, Copy, Debug)]
pub struct Request<'a> {
    /// Folder of the results.
    pub out: &'a Path,
    /// Whether it goes on from the checkpoint in its folder.
    pub resume: bool,
    /// Threads.
    pub threads: usize,
    /// What the run is known by: a checkpoint of another one is not gone on from.
    pub identity: &'a str,
}

/// What became of a run. Records hold what it gave, the time of this run as their `spent`.
#[derive(Debug)]
pub enum Ended {
    /// It reached its end.
    Done(Box<Record>),
    /// It was stopped, by its observer or a bound of its own.
    Stopped(Box<Record>),
    /// It failed, for this reason.
    Failed(Box<Record>, String),
    /// The checkpoint that it was to go on from is of no use.
    Unusable,
}
