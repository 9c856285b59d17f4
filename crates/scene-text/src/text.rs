//! The text of a scene, and the bytes of its data, read from files.

use std::fs::File;
use std::io::Read;
use std::path::Path;

use crate::diagnostic::line_and_column;

/// Longest scene file, bytes.
pub(crate) const FILE_BYTES: usize = 4 << 20;

/// True if a path is that of an open file of this process: `/dev/stdin`, or `<(command)` of a shell. Opening another
/// pipe blocks until a writer opens it.
fn is_given(path: &Path) -> bool {
    let open = ["/dev/stdin", "/dev/fd", "/proc/self/fd"];
    open.iter().any(|p| path.starts_with(p))
}

/// Reads a file of the size that a scene may have.
///
/// # Errors
/// The reason of the system; too long; no text.
pub fn read_text(path: &Path) -> Result<String, String> {
    let known = std::fs::metadata(path).map_err(|e| e.to_string())?;
    if !known.is_file() && !is_given(path) {
        return Err("it is not a file (a pipe of the shell or /dev/stdin is taken as well)".into());
    }
    let file = File::open(path).map_err(|e| e.to_string())?;
    let mut bytes = Vec::new();
    let read = file.take(FILE_BYTES as u64 + 1).read_to_end(&mut bytes);
    read.map_err(|e| e.to_string())?;
    if bytes.len() > FILE_BYTES {
        return Err(format!("it is longer than {} MiB", FILE_BYTES >> 20));
    }
    decoded(bytes).map_err(|(at, line, column)| {
        format!("byte {at}, in line {line}, is not UTF-8 text (column {column})")
    })
}

/// The text of some bytes.
///
/// # Errors
/// The number of the first byte that is not UTF-8, and its line and column.
pub fn decoded(bytes: Vec<u8>) -> Result<String, (usize, usize, usize)> {
    String::from_utf8(bytes).map_err(|e| {
        let at = e.utf8_error().valid_up_to();
        let before = String::from_utf8_lossy(&e.as_bytes()[..at]);
        let (line, column) = line_and_column(&before, at);
        (at, line, column)
    })
}

/// The bytes of a plain file that is neither empty nor longer than `most` bytes.
///
/// # Errors
/// The name of the file and its fault.
pub fn read_bytes(path: &Path, most: u64) -> Result<Vec<u8>, String> {
    let name = path.display();
    let refused = |e: std::io::Error| format!("cannot read `{name}`: {e}");
    // Asked before it is opened: opening a pipe would wait for its writer.
    let known = std::fs::metadata(path).map_err(refused)?;
    if !known.is_file() {
        return Err(format!("`{name}` is not a file"));
    }
    let length = match known.len() {
        0 => return Err(format!("`{name}` is empty")),
        n if n > most => return Err(format!("`{name}` is longer than {} MiB", most >> 20)),
        n => n,
    };
    let mut bytes = Vec::with_capacity(length as usize);
    let file = File::open(path).map_err(refused)?;
    file.take(most).read_to_end(&mut bytes).map_err(refused)?;
    Ok(bytes)
}
