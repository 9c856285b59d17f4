//! The result of a command, for programs and for people.

use serde::Serialize;
use serde_json::Value as Json;

use crate::terminal::console;

/// Findings of a command.
#[derive(Clone, Debug, Default)]
pub struct CommandOutput {
    /// For programs.
    pub json: Json,
    /// For people: the printed text.
    pub text: String,
}

impl CommandOutput {
    /// Of findings, with their text.
    pub(crate) fn new(findings: &impl Serialize, text: String) -> Self {
        let json = serde_json::to_value(findings).unwrap_or(Json::Null);
        CommandOutput { json, text }
    }

    /// Prints one of the two.
    pub(crate) fn print(&self, json: bool) {
        match json {
            true => console::json(&self.json),
            false => console::out(&self.text),
        }
    }
}

/// The end of a run, which may be a stop by the user.
#[derive(Default)]
pub struct Ended {
    /// Its summary.
    pub told: CommandOutput,
    /// Time, s, and step of a stop before the end; none if it ran to the end.
    pub interrupted: Option<(f64, u64)>,
}
