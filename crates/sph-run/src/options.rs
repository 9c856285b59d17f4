//! Options of a run.

use std::path::PathBuf;

use crate::identity::Identity;

/// Name of the checkpoint in a run's folder.
pub const CHECKPOINT: &str = "checkpoint.sph";
/// Name of the series in a run's folder.
pub const SERIES: &str = "series.csv";
/// Name of the summary in a run's folder.
pub const SUMMARY: &str = "summary.json";

/// Options of a run.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub struct RunOptions {
    /// Folder of all files of the run; it is created.
    pub out: PathBuf,
    /// Start of the run.
    pub start: Start,
    /// Threads; `None` for all cores.
    pub threads: Option<usize>,
    /// The scene with its overrides and files; a checkpoint belongs to one.
    pub identity: Identity,
}

impl RunOptions {
    /// From the start of a scene, on all cores.
    pub fn new(out: impl Into<PathBuf>, identity: Identity) -> Self {
        RunOptions {
            out: out.into(),
            start: Start::Afresh,
            threads: None,
            identity,
        }
    }

    /// With another start.
    #[must_use]
    pub fn start(mut self, start: Start) -> Self {
        self.start = start;
        self
    }

    /// On this many threads; `None` for all cores.
    #[must_use]
    pub fn threads(mut self, threads: impl Into<Option<usize>>) -> Self {
        self.threads = threads.into();
        self
    }
}

/// Start of a run.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub enum Start {
    /// At t = 0.
    #[default]
    Afresh,
    /// With the checkpoint in the run's own folder, as if it had never stopped.
    Resumed,
    /// The same, although the scene, its overrides, its files or the program are not those of the checkpoint.
    Changed,
    /// With the particles and the time of a checkpoint of another run of the same bodies, with any other settings.
    From(PathBuf),
}

impl Start {
    /// True if the run's own files are gone on with.
    pub fn goes_on(&self) -> bool {
        matches!(self, Start::Resumed | Start::Changed)
    }
}
