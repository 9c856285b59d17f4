//! Failures of a run: place, cause and remedy.

pub(crate) mod bad_pictures;
pub(crate) mod error;
pub(crate) mod findings;
pub(crate) mod remedies;
pub(crate) mod roll_back;
