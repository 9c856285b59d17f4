//! Formats of the files that hold walls.

use std::path::Path;

use crate::Line;
use crate::drawings::rows::{self, Form};

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

impl Format {
    /// The format of a file of this name, whose ending has letters of any size.
    pub fn from_name(file: &str) -> Option<Self> {
        let (_, ending) = file.rsplit_once('.')?;
        match ending.to_ascii_lowercase().as_str() {
            "svg" => Some(Format::Svg),
            "csv" | "dat" | "txt" => Some(Format::Table),
            "stl" => Some(Format::Stl),
            _ => None,
        }
    }
}

/// The lines of a file, with curves within `tolerance`; any but a drawing is taken for a table of the form.
pub(crate) fn lines(path: &Path, tolerance: f64, form: &Form) -> Result<Vec<Line>, String> {
    let (text, name) = (rows::text(path)?, path.display().to_string());
    match Format::from_name(&path.to_string_lossy()) {
        Some(Format::Svg) => Line::from_svg(&text, &name, tolerance),
        _ => rows::lines(&text, &name, form),
    }
}
