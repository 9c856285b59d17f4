//! From polylines to a mesh of segments.

mod build;
mod joints;
