//! Problems that checks find.

use sph_core::SceneProblem;

/// Collects problems with their paths.
pub(crate) struct Problems(pub Vec<SceneProblem>);

impl Problems {
    pub fn add(&mut self, path: impl Into<String>, message: impl Into<String>) {
        self.0.push(SceneProblem::new(path, message));
    }

    /// True if exactly one of the keys for `what` is given; `all` lists the possible keys, and `advice` is for several.
    pub fn one_of(
        &mut self,
        given: &[&str],
        path: &str,
        what: &str,
        [all, advice]: [&str; 2],
    ) -> bool {
        match given {
            [] => self.add(path, format!("a {what} is missing: {all}")),
            [_] => return true,
            [_, .., last] => {
                let message = format!(
                    "only one {what} can stand here, found {}{advice}",
                    given.join(", ")
                );
                self.add(format!("{path}.{last}"), message);
            }
        }
        false
    }
}
