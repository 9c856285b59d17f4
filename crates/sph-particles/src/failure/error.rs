//! Errors of a run.

use std::path::PathBuf;

use sph_core::StepError;
use sph_io::IoError;
use sph_run::Trouble;
use sph_solver::SolverError;
use thiserror::Error;

use crate::{Findings, Summary};

/// A run that stopped before its end.
#[derive(Debug, Error)]
#[error("the run failed at t = {:.6} s, step {}: {cause}", .findings.cause.time, .findings.cause.step)]
pub struct Failure {
    /// The error and its place.
    pub cause: StepError,
    /// The first step that failed, which a shorter one may have got over for a while.
    pub first: Trouble,
    /// Summary of the run so far.
    pub summary: Option<Box<Summary>>,
    /// The particle, the largest terms, and remedies.
    pub findings: Findings,
    /// Checkpoint of the last good state, if one was written.
    pub checkpoint: Option<PathBuf>,
    /// All columns of the bad state for ParaView, if they were written.
    pub bad_state: Option<PathBuf>,
    /// Pictures of the bad state, as far as they were written: all of it, and the surroundings of the particle.
    pub pictures: Vec<PathBuf>,
}

pub(crate) type Result<T, E = RunError> = std::result::Result<T, E>;

/// Anything that keeps a scene from its result.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum RunError {
    /// The scene cannot be assembled, or a stage failed outside of a step.
    #[error(transparent)]
    Solver(#[from] SolverError),
    /// The run failed.
    #[error(transparent)]
    Failed(Box<Failure>),
    /// A file cannot be read or written.
    #[error(transparent)]
    Io(#[from] IoError),
    /// A checkpoint that does not belong to the scene.
    #[error("cannot resume from {path}: {reason}")]
    Resume {
        /// The checkpoint.
        path: PathBuf,
        /// The reason.
        reason: String,
    },
}

impl From<StepError> for RunError {
    fn from(error: StepError) -> Self {
        RunError::Solver(error.into())
    }
}

impl From<sph_core::FieldError> for RunError {
    fn from(error: sph_core::FieldError) -> Self {
        RunError::Solver(error.into())
    }
}

impl RunError {
    /// One problem at a key of the scene.
    pub fn at(path: impl Into<String>, message: impl Into<String>) -> Self {
        RunError::Solver(SolverError::at(path, message))
    }
}
