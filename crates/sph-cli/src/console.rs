//! Output that does not panic when nobody listens any more.

use std::io::{IsTerminal, Write};

use crate::clean::{clean, escaped};

/// A line, or several, on stdout.
pub fn out(text: &str) {
    let mut stdout = std::io::stdout().lock();
    // `sph schema | head` closes the pipe: no reason to complain.
    let _ = writeln!(stdout, "{}", clean(text).trim_end_matches('\n'));
}

/// A line, or several, on stderr.
pub fn err(text: &str) {
    coloured(&clean(text));
}

/// The same for a text that has colours of this program's own, and nothing from outside that is not cleaned.
pub fn coloured(text: &str) {
    let mut stderr = std::io::stderr().lock();
    let _ = writeln!(stderr, "{}", text.trim_end_matches('\n'));
}

/// JSON on stdout, indented.
pub fn json(value: &serde_json::Value) {
    out(&escaped(&format!("{value:#}")));
}

/// Whether stderr is read by a person.
pub fn terminal() -> bool {
    std::io::stderr().is_terminal()
}
