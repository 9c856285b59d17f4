//! Errors between ranks.

use sph_core::{FieldError, StepError};
use thiserror::Error;

use crate::decomposition::TransportError;

/// A division of particles that is impossible.
#[derive(Clone, Debug, Error, PartialEq, Eq)]
#[error("{0}")]
pub struct DecompositionError(pub String);

/// Errors that keep a rank from its part.
#[derive(Clone, Debug, Error, PartialEq)]
#[non_exhaustive]
pub enum PartError {
    /// The particles cannot be divided.
    #[error(transparent)]
    Particles(#[from] DecompositionError),
    /// Messages fail.
    #[error(transparent)]
    Transport(#[from] TransportError),
    /// A column is missing, or a message has another length.
    #[error(transparent)]
    Field(#[from] FieldError),
    /// Another rank failed in this step.
    #[error("another rank failed in this step")]
    Elsewhere,
}

impl From<PartError> for StepError {
    fn from(error: PartError) -> Self {
        match error {
            PartError::Field(e) => StepError::Field(e),
            other => StepError::stage("ranks", other.to_string()),
        }
    }
}
