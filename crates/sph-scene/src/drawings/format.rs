//! Formats of the files that hold walls.

use std::path::Path;

use crate::Line;
use crate::drawings::heading::Form;
use crate::drawings::{rows, svg};

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

    /// Dimension of its walls.
    pub fn dimension(self) -> usize {
        match self {
            Format::Svg | Format::Table => 2,
            Format::Stl => 3,
        }
    }
}

/// The lines of a file, with curves within `tolerance`; any but a drawing is taken for a table of the form.
pub(crate) fn lines(path: &Path, tolerance: f64, form: &Form) -> Result<Vec<Line>, String> {
    match Format::from_name(&path.to_string_lossy()) {
        Some(Format::Svg) => svg::read(path, tolerance),
        _ => rows::lines(&rows::text(path)?, &path.display().to_string(), form),
    }
}
