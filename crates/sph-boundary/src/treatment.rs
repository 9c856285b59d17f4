//! Wall treatments: the contract, and the built-in ones.

pub(crate) mod contact;
pub(crate) mod contract;
pub(crate) mod dummy;
pub(crate) mod elements;
pub(crate) mod free_end_density;
pub(crate) mod impact;
pub(crate) mod moving;
pub(crate) mod near;
pub(crate) mod outline;
pub(crate) mod plates;
pub(crate) mod shaped;
pub(crate) mod shepard;
pub(crate) mod symmetric;
pub(crate) mod touching;
pub(crate) mod usaw;

pub(crate) type Staged = Result<(), sph_core::StepError>;

/// A failure of the wall stages.
pub(crate) fn stage_error(reason: impl ToString) -> sph_core::StepError {
    sph_core::StepError::stage("walls", reason.to_string())
}
