//! Mistakes of a study, each in the text where it was made.

use std::sync::Arc;

use sph_core::SceneProblem;
use sph_scene::{Diagnostic, Origin, Source};

/// A mistake with the text it stands in.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Mistake {
    /// The mistake and its place.
    pub diagnostic: Diagnostic,
    /// The text that its span is in.
    pub text: Arc<str>,
}

impl Mistake {
    /// Diagnostics of a source, each with the text that it points into.
    pub fn located(source: &Source, found: &[Diagnostic]) -> Vec<Self> {
        let mistake = |diagnostic: &Diagnostic| Mistake {
            text: source.shared_text_of(diagnostic),
            diagnostic: diagnostic.clone(),
        };
        found.iter().map(mistake).collect()
    }
}

/// A study that cannot be run; nothing was written.
#[derive(Clone, Debug, thiserror::Error)]
#[error("{}", .mistakes.iter().map(|m| m.diagnostic.to_string()).collect::<Vec<_>>().join("\n"))]
pub struct Refused {
    /// Every mistake found, without repetitions.
    pub mistakes: Vec<Mistake>,
}

impl Refused {
    /// Problems of the study file itself.
    pub(crate) fn in_study(source: &Source, problems: &[SceneProblem]) -> Self {
        Refused::from_diagnostics(source, source.diagnose(problems))
    }

    /// A problem of the study file at a path.
    pub(crate) fn at(source: &Source, path: &str, message: impl Into<String>) -> Self {
        Refused::in_study(source, &[SceneProblem::new(path, message)])
    }

    /// Mistakes that have a place in a source.
    pub(crate) fn from_diagnostics(source: &Source, found: Vec<Diagnostic>) -> Self {
        let mistakes = Mistake::located(source, &found);
        Refused { mistakes }
    }
}

/// The mistakes of a scene: in the study file if it made them. `given_by` has for every override of the scene the path
/// in the study file that gives it, if it does.
pub(crate) fn placed(
    study: &Source,
    given_by: &[Option<String>],
    scene: &Source,
    found: &[Diagnostic],
) -> Vec<Mistake> {
    let place = |d: &Diagnostic| {
        let given = match d.origin {
            Origin::Override(k) => given_by.get(k).cloned().flatten(),
            _ => None,
        };
        let Some(path) = given else {
            return Mistake::located(scene, std::slice::from_ref(d));
        };
        let message = match d.path.as_str() {
            "" => d.message.clone(),
            key => format!("{key}: {}", d.message),
        };
        Refused::at(study, &path, message).mistakes
    };
    found.iter().flat_map(place).collect()
}
