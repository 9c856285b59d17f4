//! Files that a scene names.

use toml::{Table, Value};

/// Every key `file` with the file that it names, wherever it stands, in the order of the keys.
pub fn named_files(scene: &Table) -> Vec<(String, String)> {
    let mut found = Vec::new();
    for (key, value) in scene {
        collect(value, key, key, &mut found);
    }
    found
}

fn collect(value: &Value, key: &str, path: &str, found: &mut Vec<(String, String)>) {
    match value {
        Value::String(file) if key == "file" => found.push((path.to_string(), file.clone())),
        Value::Table(table) => {
            for (key, value) in table {
                collect(value, key, &format!("{path}.{key}"), found);
            }
        }
        Value::Array(items) => {
            for (k, item) in items.iter().enumerate() {
                collect(item, "", &format!("{path}[{k}]"), found);
            }
        }
        _ => {}
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn files_are_found_wherever_they_are_named() {
        let scene = "reference.a.file = 'a.csv'\n[wall.w]\nmotion.translate = [{ file = 'b.csv' }]";
        let found = named_files(&toml::from_str(scene).unwrap());
        let found: Vec<_> = found.into_iter().map(|(k, f)| format!("{k}={f}")).collect();
        let moved = "wall.w.motion.translate[0].file=b.csv";
        assert_eq!(found, ["reference.a.file=a.csv", moved]);
    }
}
