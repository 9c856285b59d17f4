//! Values at a place, from the particles around it.

pub(crate) mod interpolate;
pub(crate) mod near;
