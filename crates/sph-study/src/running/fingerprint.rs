//! What a variant's result depends on, as one short text.

use sph_core::SceneProblem;

use crate::subject::Subject;

/// Version of the program, part of every fingerprint.
pub const VERSION: &str = env!("CARGO_PKG_VERSION");

/// A fingerprint of the resolved scene, the content of its data files, and the program's version.
///
/// Titles and descriptions do not count.
///
/// # Errors
/// A data file that cannot be read, at its key.
pub fn fingerprint(subject: &dyn Subject) -> Result<String, SceneProblem> {
    let mut scene = subject.resolved();
    scene.remove("title");
    scene.remove("description");
    let mut text = format!(
        "sph {VERSION}\n{}",
        toml::to_string(&scene).unwrap_or_default()
    );
    for (key, content) in subject.marks()? {
        text.push_str(&format!("{key} {content}\n"));
    }
    Ok(format!(
        "{:08x}-{}",
        crc32fast::hash(text.as_bytes()),
        text.len()
    ))
}
