//! Lines and triangles from files.

pub(crate) mod format;
pub(crate) mod rows;
pub(crate) mod svg;
