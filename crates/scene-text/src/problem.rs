//! Something wrong with a scene, by its key.

use thiserror::Error;

/// Something wrong with the text of a scene, addressed by its key.
#[derive(Clone, Debug, PartialEq, Error)]
#[error("{path}: {message}")]
pub struct SceneProblem {
    /// Dotted path of the key, `phase.water.density`.
    pub path: String,
    /// What is wrong, what was expected, the nearest valid name.
    pub message: String,
}

impl SceneProblem {
    /// A problem at a key.
    pub fn new(path: impl Into<String>, message: impl Into<String>) -> Self {
        SceneProblem {
            path: path.into(),
            message: message.into(),
        }
    }
}
