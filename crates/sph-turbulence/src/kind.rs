//! The kind of all closures.

/// Its name in scenes.
pub(crate) const KIND: &str = "eddy-viscosity";
