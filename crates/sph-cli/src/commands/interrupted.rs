//! Files of a run that ended early, and the command that resumes it.

use std::path::{Path, PathBuf};

use serde_json::Value as Json;
use sph_io::IoError;

use crate::arguments::RunArguments;
use crate::terminal::shell::quoted;

/// The command that resumes the run.
pub fn going_on(arguments: &RunArguments, out: &Path) -> String {
    let mut words = vec!["sph".to_string(), "run".to_string()];
    words.push(quoted(&arguments.scene.scene));
    words.extend(["--out".to_string(), quoted(&out.display().to_string())]);
    for set in &arguments.scene.set {
        words.extend(["--set".to_string(), quoted(set)]);
    }
    for folder in &arguments.scene.allow_path {
        words.extend(["--allow-path".into(), quoted(&folder.display().to_string())]);
    }
    words.push("--resume".to_string());
    words.join(" ")
}

/// First remedy where a file could not be written.
pub fn remedy(error: &IoError) -> Option<&'static str> {
    match error {
        IoError::DiskFull { .. } => Some("make room"),
        IoError::Write { .. } | IoError::NotWritable { .. } => Some("make the folder writable"),
        _ => None,
    }
}

/// The summary that a failed run left; not one of an earlier run.
pub fn failed_summary(path: &PathBuf) -> Option<Json> {
    let text = std::fs::read_to_string(path).ok()?;
    let summary: Json = serde_json::from_str(&text).ok()?;
    (summary["status"] == "failed").then_some(summary)
}
