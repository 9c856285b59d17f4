//! Formats of the files that hold walls.

use std::path::Path;

use crate::Line;
use crate::drawings::rows::{self, Form};
use crate::drawings::svg;

/// Format of a file, by its ending.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Format {
    /// Lines of a drawing.
    Svg,
    /// Lines as two columns of numbers.
    Table,
    /// Triangles.
    Stl,
}

const ENDINGS: [(&str, Format); 5] = [
    ("svg", Format::Svg),
    ("csv", Format::Table),
    ("dat", Format::Table),
    ("txt", Format::Table),
    ("stl", Format::Stl),
];

impl Format {
    /// The format of a file of this name, whose ending has letters of any size.
    pub fn from_name(file: &str) -> Option<Self> {
        let (_, ending) = file.rsplit_once('.')?;
        let found = ENDINGS.iter().find(|(e, _)| e.eq_ignore_ascii_case(ending));
        found.map(|(_, format)| *format)
    }
}

/// The lines of a file, with curves within `tolerance`; any but a drawing is taken for a table of the form.
pub(crate) fn lines(path: &Path, tolerance: f64, form: &Form) -> Result<Vec<Line>, String> {
    let (text, name) = (rows::text(path)?, path.display().to_string());
    match Format::from_name(&path.to_string_lossy()) {
        Some(Format::Svg) => svg::parse(&text, &name, tolerance),
        _ => rows::lines(&text, &name, form),
    }
}

impl Line {
    /// The lines of an SVG drawing in user units, curves within `tolerance` user units.
    ///
    /// # Errors
    /// If it is no drawing, holds no lines, or is too large for the tolerance: the given name, the place, the fault there.
    pub fn from_svg(text: &str, name: &str, tolerance: f64) -> Result<Vec<Self>, String> {
        svg::parse(text, name, tolerance)
    }

    /// The lines of a table of two columns, one for every block of rows.
    ///
    /// # Errors
    /// If a row is not two finite numbers, or a line has one corner only: the given name, the place, the fault there.
    pub fn from_csv(text: &str, name: &str) -> Result<Vec<Self>, String> {
        rows::lines(text, name, &Form::places(&None, None))
    }
}
