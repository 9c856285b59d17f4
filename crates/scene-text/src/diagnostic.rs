//! A mistake with its place in the text.

use std::fmt;
use std::ops::Range;

/// The text of a mistake.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Origin {
    /// The scene file.
    File,
    /// An override, by its number in the list that was given.
    Override(usize),
}

/// A mistake in a scene: its message and its place.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Diagnostic {
    /// The defect, the expected value, the nearest valid name.
    pub message: String,
    /// Dotted path of the key, empty for the scene as a whole and for errors of syntax.
    pub path: String,
    /// Bytes of the text that are meant; see [`Source::text_of`](crate::Source::text_of).
    pub span: Range<usize>,
    /// Line of its start, from 1.
    pub line: usize,
    /// Column of its start in characters, from 1.
    pub column: usize,
    /// Name of the file, `--set` for an override.
    pub file: String,
    /// The text of the span.
    pub origin: Origin,
}

impl fmt::Display for Diagnostic {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}:{}:{}: ", self.file, self.line, self.column)?;
        if !self.path.is_empty() {
            write!(f, "{}: ", self.path)?;
        }
        f.write_str(&self.message)
    }
}

/// Line and column, from 1, of a byte; a byte past the end counts as the end.
pub(crate) fn line_and_column(text: &str, byte: usize) -> (usize, usize) {
    let before = &text[..text.floor_char_boundary(byte)];
    let start = before.rfind('\n').map_or(0, |n| n + 1);
    let line = before.bytes().filter(|b| *b == b'\n').count() + 1;
    (line, before[start..].chars().count() + 1)
}
