//! What a checkpoint belongs to: a scene, the files it read, a version of the program.

use serde::{Deserialize, Serialize};
use sph_io::Checksum;
use sph_scene::Loaded;
use sph_solver::SolverError;

/// Version of the program.
pub(crate) const VERSION: &str = env!("CARGO_PKG_VERSION");
/// Longest file that a scene may name, bytes: that of a triangle mesh.
const LONGEST: u64 = 512 << 20;

/// All that the results of a run depend on, except the folder and the number of threads.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Identity {
    /// Text of the scene and what was put on top.
    pub scene: String,
    /// Version of the program; none in checkpoints of before it was kept.
    #[serde(default)]
    pub version: Option<String>,
    /// Every file that the scene names.
    #[serde(default)]
    pub files: Vec<FileMark>,
}

/// A file and what was in it.
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

    /// That of a scene: its text, its overrides, and the content of every file that it names.
    ///
    /// # Errors
    /// A file that cannot be read, at its key.
    pub fn of(loaded: &Loaded) -> Result<Self, SolverError> {
        let source = &loaded.source;
        let set = source.overrides().iter();
        let set = set.map(|o| format!("\n--set {}", o.text()));
        let text = std::iter::once(source.text().to_string()).chain(set);
        Ok(Identity {
            files: marks(loaded)?,
            ..Identity::of_text(text.collect::<String>())
        })
    }

    /// How this scene differs from the one that a checkpoint was written with, if it does.
    pub(crate) fn differs_from(&self, written: &Identity) -> Option<String> {
        let changed = changed(&written.files, &self.files);
        if self.scene != written.scene {
            return Some(
                "it was written by a different scene or with other `--set` options".into(),
            );
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

/// Every file that a scene names, with what is in it.
///
/// # Errors
/// A file that cannot be read, at its key.
pub fn marks(loaded: &Loaded) -> Result<Vec<FileMark>, SolverError> {
    let mark = |file: sph_scene::DataFile| {
        let path = file.path;
        let path = path.map_err(|e| SolverError::at(file.key.clone(), e.to_string()))?;
        let content = sph_io::checksum(&path, LONGEST);
        Ok(FileMark {
            content: content.map_err(|e| SolverError::at(file.key.clone(), e.to_string()))?,
            key: file.key,
            file: file.named,
        })
    };
    loaded.files().into_iter().map(mark).collect()
}

/// The files that are not what they were.
fn changed(before: &[FileMark], now: &[FileMark]) -> Vec<String> {
    let differs = |mark: &&FileMark| {
        let then = before.iter().find(|b| b.key == mark.key);
        then.is_none_or(|b| b.content != mark.content)
    };
    let told = |mark: &FileMark| format!("`{}` ({})", mark.file, mark.key);
    now.iter().filter(differs).map(told).collect()
}
