//! Options of a run, and the identity of its checkpoints: scene, files that it read, version of the program.

use std::path::PathBuf;

use scene_text::{SceneProblem, Source, named_files};
use serde::{Deserialize, Serialize};
use sph_io::Checksum;
use toml::Table;

/// Version of the program.
pub(crate) const VERSION: &str = env!("CARGO_PKG_VERSION");

/// All that the results of a run depend on, except the folder and the number of threads.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Identity {
    /// Text of the scene and of its overrides.
    pub scene: String,
    /// Version of the program; none in checkpoints of before it was kept.
    #[serde(default)]
    pub version: Option<String>,
    /// Every file that the scene names.
    #[serde(default)]
    pub files: Vec<FileMark>,
}

/// A file and its contents.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct FileMark {
    /// Dotted path of the key that names it.
    pub key: String,
    /// The file as the scene names it.
    pub file: String,
    /// Length and checksum of its content.
    pub content: Checksum,
}

impl Identity {
    /// That of a text alone.
    pub fn of_text(scene: impl Into<String>) -> Self {
        Identity {
            scene: scene.into(),
            version: Some(VERSION.to_string()),
            files: Vec::new(),
        }
    }

    /// Difference of this scene from that of a checkpoint, if there is one.
    pub fn differs_from(&self, written: &Identity) -> Option<String> {
        let changed = changed(&written.files, &self.files);
        if self.scene != written.scene {
            let why = "it was written by a different scene or with other `--set` options";
            return Some(why.into());
        }
        if !changed.is_empty() {
            let files = changed.join(", ");
            return Some(format!(
                "what the scene reads has changed since it was written: {files}"
            ));
        }
        match &written.version {
            same if *same == self.version => None,
            Some(other) => Some(format!(
                "it was written by sph {other}, and this is {VERSION}"
            )),
            None => Some("it was written by an earlier version of sph".into()),
        }
    }
}

/// Longest file that a scene may name, bytes: that of a triangle mesh.
const LONGEST: u64 = 512 << 20;

/// Every file that a scene names, with its content; the table is that of the whole scene.
///
/// # Errors
/// A file that cannot be read, at its key.
pub fn marks(source: &Source, resolved: &Table) -> Result<Vec<FileMark>, SceneProblem> {
    let mark = |(key, file): (String, String)| {
        let at_key = |why: String| SceneProblem::new(key.clone(), why);
        let path = source.resolve(&key, &file).map_err(at_key)?;
        let content = sph_io::checksum(&path, LONGEST).map_err(|e| at_key(e.to_string()))?;
        Ok(FileMark { content, key, file })
    };
    named_files(resolved).into_iter().map(mark).collect()
}

/// The files that have changed.
fn changed(before: &[FileMark], now: &[FileMark]) -> Vec<String> {
    let differs = |mark: &&FileMark| {
        let then = before.iter().find(|b| b.key == mark.key);
        then.is_none_or(|b| b.content != mark.content)
    };
    let told = |mark: &FileMark| format!("`{}` ({})", mark.file, mark.key);
    now.iter().filter(differs).map(told).collect()
}

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
