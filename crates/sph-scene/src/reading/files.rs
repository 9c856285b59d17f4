//! Every file that a scene names.

use std::path::PathBuf;

use scene_text::named_files;

use crate::{Loaded, PathProblem};

/// A file that a scene names: walls, motions, references, probes.
#[derive(Clone, Debug)]
pub struct DataFile {
    /// Dotted path of the key.
    pub key: String,
    /// The file as the scene names it.
    pub named: String,
    /// Path of the file, if the scene may name it.
    pub path: Result<PathBuf, PathProblem>,
}

impl Loaded {
    /// Every file that the scene names, in the order of its keys.
    pub fn files(&self) -> Vec<DataFile> {
        let placed = |(key, named): (String, String)| DataFile {
            path: self.source.resolve(&key, &named),
            key,
            named,
        };
        named_files(&self.resolved())
            .into_iter()
            .map(placed)
            .collect()
    }
}
