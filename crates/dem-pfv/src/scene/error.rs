//! Errors of scenes that cannot be read, assembled or run.

use scene_text::SceneProblem;
use sph_io::IoError;
use thiserror::Error;

use crate::coupled::CoupledError;

/// Errors that keep a scene from its end.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum DemError {
    /// Mistakes of the scene, by their keys.
    #[error("{}", .0.iter().map(ToString::to_string).collect::<Vec<_>>().join("; "))]
    Scene(Vec<SceneProblem>),
    /// A file.
    #[error(transparent)]
    Io(#[from] IoError),
    /// A checkpoint that does not fit.
    #[error("cannot resume: {0}")]
    Resume(String),
    /// Threads that could not be started, and the reason of the system.
    #[error("cannot start {0} threads: {1}")]
    Threads(usize, String),
    /// The run failed.
    #[error(transparent)]
    Failed(#[from] Box<Failure>),
}

impl DemError {
    /// A mistake at a key.
    pub(crate) fn at(path: impl Into<String>, message: impl ToString) -> Self {
        Self::Scene(vec![SceneProblem::new(path, message.to_string())])
    }

    /// 2 where nothing was run because of a wrong request, 1 otherwise.
    pub fn exit_code(&self) -> u8 {
        match self {
            Self::Scene(_) | Self::Resume(_) => 2,
            Self::Io(_) | Self::Threads(..) | Self::Failed(_) => 1,
        }
    }
}

/// A step that went wrong.
#[derive(Debug, Error)]
#[error("at t = {time} s, step {step}: {error}{named}")]
pub struct Failure {
    /// Time, s.
    pub time: f64,
    /// Steps made.
    pub step: u64,
    /// The error; it names the grain, the wall or the cell.
    #[source]
    pub error: CoupledError,
    /// Names of the grains and the wall that the error has as numbers, in brackets; empty without names.
    pub named: String,
    /// The grain at fault, if it is one.
    pub grain: Option<usize>,
    /// Place of that grain, m.
    pub position: Option<[f64; 3]>,
}
