//! Drawings from bytes, wherever these come from.

use thiserror::Error;

use crate::Line;
use crate::drawings::heading::Form;
use crate::drawings::rows;
use crate::drawings::svg;

/// Errors of drawings: the given name, the place, the fault there.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
#[error("{0}")]
pub struct DrawingError(String);

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
        rows::lines(text, name, &Form::places(&None, None)).map_err(DrawingError)
    }
}
