//! Every file that a scene names.

use std::path::PathBuf;

use toml::{Table, Value};

use crate::{Loaded, PathProblem};

/// A file that a scene names: walls, motions, references, probes.
#[derive(Clone, Debug)]
pub struct DataFile {
    /// Dotted path of the key.
    pub key: String,
    /// The file as the scene names it.
    pub named: String,
    /// Path of the file, if the scene may name it.
    pub path: Result<PathBuf, PathProblem>,
}

impl Loaded {
    /// Every file that the scene names, in the order of its keys.
    pub fn files(&self) -> Vec<DataFile> {
        let mut found = Vec::new();
        for (key, value) in &self.resolved() {
            collect_files(value, key, key, &mut found);
        }
        let placed = |(key, named): (String, String)| DataFile {
            path: self.source.resolve(&key, &named),
            key,
            named,
        };
        found.into_iter().map(placed).collect()
    }
}

/// Every key `file` with the file it names.
fn collect_files(value: &Value, key: &str, path: &str, found: &mut Vec<(String, String)>) {
    match value {
        Value::String(file) if key == "file" => found.push((path.to_string(), file.clone())),
        Value::Table(table) => tables(table, path, found),
        Value::Array(items) => {
            for (k, item) in items.iter().enumerate() {
                collect_files(item, "", &format!("{path}[{k}]"), found);
            }
        }
        _ => {}
    }
}

fn tables(table: &Table, path: &str, found: &mut Vec<(String, String)>) {
    for (key, value) in table {
        collect_files(value, key, &format!("{path}.{key}"), found);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn files_are_found_wherever_they_are_named() {
        let scene = "reference.a.file = 'a.csv'\n[wall.w]\nmotion.translate = [{ file = 'b.csv' }]";
        let scene: Table = toml::from_str(scene).unwrap();
        let mut found = Vec::new();
        for (key, value) in &scene {
            collect_files(value, key, key, &mut found);
        }
        let found: Vec<_> = found.into_iter().map(|(k, f)| format!("{k}={f}")).collect();
        assert_eq!(
            found,
            [
                "reference.a.file=a.csv",
                "wall.w.motion.translate[0].file=b.csv"
            ]
        );
    }
}
