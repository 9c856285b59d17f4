//! Errors of the assembly of a flow.

use sph_core::{PlanError, SceneProblem, StepError};
use thiserror::Error;

/// Anything that keeps a scene from a flow that can be stepped.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum SolverError {
    /// The scene has a wrong name or an impossible value.
    #[error("{}", .0.iter().map(ToString::to_string).collect::<Vec<_>>().join("\n"))]
    Scene(Vec<SceneProblem>),
    /// The plugins of the scene do not fit together.
    #[error(transparent)]
    Plan(#[from] PlanError),
    /// A stage failed before the first step.
    #[error(transparent)]
    Step(#[from] StepError),
}

impl From<sph_core::FieldError> for SolverError {
    fn from(error: sph_core::FieldError) -> Self {
        SolverError::Step(error.into())
    }
}

impl From<SceneProblem> for SolverError {
    fn from(problem: SceneProblem) -> Self {
        SolverError::Scene(vec![problem])
    }
}

impl SolverError {
    /// One problem at a key of the scene.
    pub fn at(path: impl Into<String>, message: impl Into<String>) -> Self {
        SceneProblem::new(path, message).into()
    }

    /// All problems of a scene, if there are some.
    ///
    /// # Errors
    /// The problems.
    pub fn refuse(problems: Vec<SceneProblem>) -> Result<(), Self> {
        match problems.is_empty() {
            true => Ok(()),
            false => Err(SolverError::Scene(problems)),
        }
    }
}
