//! The kind of all closures.

pub(crate) const KIND: &str = "eddy-viscosity";
