//! From the file of a study to its variants.

pub mod axis;
pub mod combine;
pub mod file;
pub mod ladder;
pub mod mistake;
pub mod plan;
pub mod reader;
pub mod variant;
