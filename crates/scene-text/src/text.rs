//! The text of a scene: read from a file, and as a table.

use std::io::Read;
use std::path::Path;

use toml::Table;
use toml::de::DeTable;

use crate::diagnostic::{Diagnostic, Origin, line_and_column};
use crate::{MOST_PROBLEMS, Override, Source};

/// Longest scene file, bytes.
pub const FILE_BYTES: usize = 4 << 20;

/// Whether a path is that of an open file of this process: `/dev/stdin`, or `<(command)` of a shell. Opening
/// another pipe would wait for its writer, for ever if there is none.
fn is_given(path: &Path) -> bool {
    let open = ["/dev/stdin", "/dev/fd", "/proc/self/fd"];
    open.iter().any(|p| path.starts_with(p))
}

/// Reads a file of the size that a scene may have.
///
/// # Errors
/// What the system says, or that it is too long or no text.
pub fn read_text(path: &Path) -> Result<String, String> {
    let known = std::fs::metadata(path).map_err(|e| e.to_string())?;
    if !known.is_file() && !is_given(path) {
        return Err("it is not a file (a pipe of the shell or /dev/stdin is taken as well)".into());
    }
    let file = std::fs::File::open(path).map_err(|e| e.to_string())?;
    let mut bytes = Vec::new();
    let most = FILE_BYTES as u64 + 1;
    file.take(most)
        .read_to_end(&mut bytes)
        .map_err(|e| e.to_string())?;
    if bytes.len() > FILE_BYTES {
        return Err(format!("it is longer than {} MiB", FILE_BYTES >> 20));
    }
    String::from_utf8(bytes).map_err(|e| {
        let at = e.utf8_error().valid_up_to();
        let before = String::from_utf8_lossy(&e.as_bytes()[..at]);
        let (line, column) = line_and_column(&before, at);
        format!("byte {at}, in line {line}, is not UTF-8 text (column {column})")
    })
}

/// The table of the file with the overrides applied.
pub(crate) fn table(source: &Source) -> Result<Table, Vec<Diagnostic>> {
    let text = source.text();
    let whole = |message: &str| vec![source.diagnostic(Origin::File, 0..0, "", message)];
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
        source.diagnostic(Origin::File, span, "", message)
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
    let problems: Vec<_> = source.overrides().iter().filter_map(apply).collect();
    match problems.is_empty() {
        true => Ok(table),
        false => Err(source.diagnose(&problems)),
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
