//! The scene that a study names, as a text.

use std::path::{Path, PathBuf};

use sph_run::Method;

/// The text of a scene and the file name against which it names other files.
#[derive(Clone, Debug)]
pub struct SceneText {
    /// Name without folder and extension.
    pub name: String,
    /// Its text.
    pub text: String,
    /// Its file.
    pub file: String,
    /// Folders besides its own whose files it may name.
    pub allowed: Vec<PathBuf>,
    /// Method that computes the scene.
    pub method: &'static dyn Method,
}

/// Finds the scene that a study names, from the study's folder; the error is passed on.
pub type FindScene<'a> = dyn Fn(&Path, &str) -> Result<SceneText, String> + 'a;
