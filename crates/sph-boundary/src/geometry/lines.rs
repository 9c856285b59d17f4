//! From polylines to a mesh of segments.

mod build;
mod ends;
mod joints;
mod outside;
