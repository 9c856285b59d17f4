//! Anything serialisable as pretty JSON, all or nothing.

use std::path::Path;

use serde::Serialize;

use crate::error::{IoError, Result};
use crate::files::atomic::{Durability, write_atomic};

/// Writes `value` to `path` as indented JSON with a final newline.
///
/// JSON has no NaN and no infinity: such numbers become `null`.
pub fn write_json(path: impl AsRef<Path>, value: &(impl Serialize + ?Sized)) -> Result<()> {
    let path = path.as_ref();
    let mut text = serde_json::to_vec_pretty(value).map_err(|source| IoError::Json {
        path: path.to_path_buf(),
        source,
    })?;
    text.push(b'\n');
    write_atomic(path, Durability::Process, |file| file.write_all(&text))
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::BTreeMap;

    #[test]
    fn written_values_are_read_back() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("summary.json");
        write_json(&path, &serde_json::json!({"steps": 12, "dt": 0.1})).unwrap();
        let text = std::fs::read_to_string(&path).unwrap();
        assert!(text.ends_with("}\n") && text.contains("  \"steps\": 12"));
        let back: serde_json::Value = serde_json::from_str(&text).unwrap();
        assert_eq!(back["dt"], 0.1);
    }

    #[test]
    fn values_outside_json_leave_the_file_unchanged() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("summary.json");
        let odd = BTreeMap::from([(vec![1], 1)]);
        let error = write_json(&path, &odd).unwrap_err();
        assert!(matches!(error, IoError::Json { .. }));
        assert!(!path.exists());
    }
}
