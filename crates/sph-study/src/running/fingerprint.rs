//! What a variant's result depends on, as one short text.

use sph_scene::Loaded;
use sph_solver::{SolverError, marks};

/// Version of the program, part of every fingerprint.
pub const VERSION: &str = env!("CARGO_PKG_VERSION");

/// A fingerprint of the resolved scene, the content of its data files, and the program's version.
///
/// Titles and descriptions do not count.
///
/// # Errors
/// A data file that cannot be read, with its key.
pub fn fingerprint(loaded: &Loaded) -> Result<String, (String, String)> {
    let mut scene = loaded.resolved();
    scene.remove("title");
    scene.remove("description");
    let mut text = format!(
        "sph {VERSION}\n{}",
        toml::to_string(&scene).unwrap_or_default()
    );
    let marks = marks(loaded).map_err(|error| match error {
        SolverError::Scene(problems) => {
            let first = problems.into_iter().next();
            first.map_or_else(Default::default, |p| (p.path, p.message))
        }
        other => (String::new(), other.to_string()),
    })?;
    for mark in marks {
        text.push_str(&format!("{} {}\n", mark.key, mark.content));
    }
    Ok(format!(
        "{:08x}-{}",
        crc32fast::hash(text.as_bytes()),
        text.len()
    ))
}
