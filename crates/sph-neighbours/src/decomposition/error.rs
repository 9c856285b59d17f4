//! Errors between ranks, and limits of their particles.

use serde::Serialize;
use sph_core::{FieldError, StepError};
use thiserror::Error;

use crate::decomposition::{DecompositionError, TransportError};

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

/// Particles of a rank.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
pub struct RankParticles {
    /// That it owns.
    pub own: usize,
    /// Copies of others'.
    pub ghosts: usize,
    /// Its own that others have copies of, each as often as it is sent.
    pub sent: usize,
}
