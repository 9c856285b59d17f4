//! Identity of a checkpoint: the scene and the files that it reads.

use sph_run::{FileMark, Identity};
use sph_scene::Loaded;
use sph_solver::SolverError;

/// Longest file that a scene may name, bytes: that of a triangle mesh.
const LONGEST: u64 = 512 << 20;

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
        files: marks(loaded)?,
        ..Identity::of_text(text.collect::<String>())
    })
}

/// Every file that a scene names, with its contents.
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
