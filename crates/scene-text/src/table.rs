//! The text of a scene as a table.

use toml::Table;
use toml::de::DeTable;

use crate::diagnostic::{Diagnostic, Origin};
use crate::text::FILE_BYTES;
use crate::{MOST_PROBLEMS, Override, Source};

impl Source {
    /// The table of the text with the overrides applied.
    ///
    /// # Errors
    /// Errors of syntax, and overrides that do not fit the text.
    pub fn table(&self) -> Result<Table, Vec<Diagnostic>> {
        let text = self.text();
        let whole = |message: &str| vec![self.diagnostic(Origin::File, 0..0, "", message)];
        if text.len() > FILE_BYTES {
            return Err(whole(&format!(
                "the file is longer than {} MiB",
                FILE_BYTES >> 20
            )));
        }
        let syntax = |e: &toml::de::Error| {
            let span = e.span().unwrap_or_else(|| too_deep(text, e.message()));
            let message = match e.message() {
                long if long.contains("as i128") => "the integer does not fit into 64 bits",
                message => message,
            };
            self.diagnostic(Origin::File, span, "", message)
        };
        let (_, errors) = DeTable::parse_recoverable(text);
        if !errors.is_empty() {
            let told = errors.iter().take(MOST_PROBLEMS);
            let mut all: Vec<_> = told.map(syntax).collect();
            all.sort_by_key(|d| (d.span.start, d.span.end));
            all.dedup_by_key(|d| d.line);
            return Err(all);
        }
        let mut table: Table = toml::from_str(text).map_err(|e| vec![syntax(&e)])?;
        let apply = |o: &Override| o.apply(&mut table).err();
        let problems: Vec<_> = self.overrides().iter().filter_map(apply).collect();
        match problems.is_empty() {
            true => Ok(table),
            false => Err(self.diagnose(&problems)),
        }
    }
}

/// Deepest nesting that the reader of TOML takes.
const DEEPEST: usize = 80;

/// Where a text is nested too deeply: the reader tells that without a place.
fn too_deep(text: &str, message: &str) -> std::ops::Range<usize> {
    if !message.contains("recursion") {
        return 0..0;
    }
    let mut depth = 0_usize;
    // Of a key in this place: `a.b.c` is nested as well.
    let mut dots = 0_usize;
    for (k, byte) in text.bytes().enumerate() {
        match byte {
            b'[' | b'{' => depth += 1,
            b']' | b'}' => depth = depth.saturating_sub(1),
            b'.' => dots += 1,
            b'-' | b'_' | b'"' | b'\'' => {}
            b if b.is_ascii_alphanumeric() => {}
            _ => dots = 0,
        }
        if depth + dots > DEEPEST {
            return k..k + 1;
        }
    }
    0..0
}
