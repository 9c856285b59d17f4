//! Drawings from bytes, wherever these come from.

use thiserror::Error;

use crate::drawings::rows;
use crate::drawings::stl;
use crate::drawings::svg;
use crate::{Facets, Line};

/// Why a drawing cannot be read: the name that it was given, the place, what is wrong there.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
#[error("{0}")]
pub struct DrawingError(String);

impl Facets {
    /// The triangles of an STL file, ascii or binary; `name` is what errors call it.
    ///
    /// # Errors
    /// If it is damaged, declares more than it holds, or holds no triangles.
    pub fn from_stl(bytes: Vec<u8>, name: &str) -> Result<Self, DrawingError> {
        let read = stl::parse(bytes, name).map_err(DrawingError)?;
        Ok(read.0)
    }
}

impl Line {
    /// The lines of an SVG drawing in user units, curves within `tolerance` user units.
    ///
    /// # Errors
    /// If it is no drawing, holds no lines, or is too large for the tolerance.
    pub fn from_svg(text: &str, name: &str, tolerance: f64) -> Result<Vec<Self>, DrawingError> {
        svg::parse(text, name, tolerance).map_err(DrawingError)
    }

    /// The lines of a table of two columns, one for every block of rows.
    ///
    /// # Errors
    /// If a row is not two finite numbers, or a line has one corner only.
    pub fn from_csv(text: &str, name: &str) -> Result<Vec<Self>, DrawingError> {
        rows::lines(text, name).map_err(DrawingError)
    }
}
