//! What checks find.

use sph_core::SceneProblem;

/// Collects problems with their paths.
pub(crate) struct Problems(pub Vec<SceneProblem>);

impl Problems {
    pub fn add(&mut self, path: impl Into<String>, message: impl Into<String>) {
        self.0.push(SceneProblem::new(path, message));
    }
}
