//! Output that does not panic when its reader has gone.

use std::io::{ErrorKind, IsTerminal, Write};
use std::sync::atomic::{AtomicBool, Ordering};

use sph_io::{clean, escaped};

/// A line, or several, on stdout.
pub fn out(text: &str) {
    raw(format!("{}\n", clean(text).trim_end_matches('\n')).as_bytes());
}

/// Bytes on stdout as they are, made by this program alone; output that could not be written is reported once.
pub fn raw(bytes: &[u8]) {
    let mut stdout = std::io::stdout().lock();
    let written = stdout.write_all(bytes).and_then(|()| stdout.flush());
    // `sph schema | head` closes the pipe: no reason to complain.
    if let Err(error) = written
        && error.kind() != ErrorKind::BrokenPipe
        && !UNWRITTEN.swap(true, Ordering::Relaxed)
    {
        err(&format!("error: cannot write to stdout: {error}"));
    }
}

/// True if output on stdout is incomplete.
static UNWRITTEN: AtomicBool = AtomicBool::new(false);

/// True if stdout took all output.
pub fn complete() -> bool {
    !UNWRITTEN.load(Ordering::Relaxed)
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

/// True if stderr is read by a person.
pub fn terminal() -> bool {
    std::io::stderr().is_terminal()
}
