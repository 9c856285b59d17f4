//! Output that does not panic when its reader has gone, and the result of a command, for programs and for people.

use std::io::{ErrorKind, IsTerminal, Write};
use std::sync::atomic::{AtomicBool, Ordering};

use serde::Serialize;
use serde_json::Value as Json;
use sph_io::{clean, escaped};

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

static UNWRITTEN: AtomicBool = AtomicBool::new(false);

pub fn complete() -> bool {
    !UNWRITTEN.load(Ordering::Relaxed)
}

pub fn err(text: &str) {
    coloured(&clean(text));
}

/// The same for a text that has colours of this program's own, and nothing from outside that is not cleaned.
pub fn coloured(text: &str) {
    let mut stderr = std::io::stderr().lock();
    let _ = writeln!(stderr, "{}", text.trim_end_matches('\n'));
}

pub fn json(value: &Json) {
    out(&escaped(&format!("{value:#}")));
}

pub fn terminal() -> bool {
    std::io::stderr().is_terminal()
}

/// Findings of a command.
#[derive(Clone, Debug, Default)]
pub struct CommandOutput {
    /// For programs.
    pub json: Json,
    /// For people: the printed text.
    pub text: String,
}

impl CommandOutput {
    pub(crate) fn new(findings: &impl Serialize, text: String) -> Self {
        let json = serde_json::to_value(findings).unwrap_or(Json::Null);
        CommandOutput { json, text }
    }

    pub(crate) fn print(&self, as_json: bool) {
        match as_json {
            true => json(&self.json),
            false => out(&self.text),
        }
    }
}
