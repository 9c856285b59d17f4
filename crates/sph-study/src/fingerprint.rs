//! What a variant's result depends on, as one short text.

use std::path::PathBuf;

use sph_scene::Loaded;
use toml::{Table, Value};

/// Version of the program, part of every fingerprint.
pub const VERSION: &str = env!("CARGO_PKG_VERSION");

/// Longest data file, bytes.
const LONGEST: u64 = 512 << 20;

/// A fingerprint of the resolved scene, the content of its data files, and the program's version.
///
/// Titles and descriptions do not count.
///
/// # Errors
/// A data file that cannot be read, with its key.
pub fn fingerprint(loaded: &Loaded) -> Result<String, (String, String)> {
    let mut scene = loaded.resolved();
    scene.remove("title");
    scene.remove("description");
    let mut text = format!(
        "sph {VERSION}\n{}",
        toml::to_string(&scene).unwrap_or_default()
    );
    for (key, named) in files(&scene) {
        let told = |why: String| (key.clone(), format!("cannot read `{named}`: {why}"));
        let path: PathBuf = loaded
            .source
            .resolve(&key, &named)
            .map_err(|e| told(e.to_string()))?;
        sph_io::readable(&path, LONGEST).map_err(|e| told(e.to_string()))?;
        let bytes = std::fs::read(path).map_err(|e| told(e.to_string()))?;
        text.push_str(&format!(
            "{key} {} {:08x}\n",
            bytes.len(),
            crc32fast::hash(&bytes)
        ));
    }
    Ok(format!(
        "{:08x}-{}",
        crc32fast::hash(text.as_bytes()),
        text.len()
    ))
}

/// Every key `file` of a scene with the file it names.
fn files(scene: &Table) -> Vec<(String, String)> {
    let mut found = Vec::new();
    for (key, value) in scene {
        within(value, key, key, &mut found);
    }
    found
}

fn within(value: &Value, key: &str, path: &str, found: &mut Vec<(String, String)>) {
    match value {
        Value::String(file) if key == "file" => found.push((path.to_string(), file.clone())),
        Value::Table(table) => {
            for (key, value) in table {
                within(value, key, &format!("{path}.{key}"), found);
            }
        }
        Value::Array(items) => {
            for (k, item) in items.iter().enumerate() {
                within(item, "", &format!("{path}[{k}]"), found);
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
        let scene =
            "[reference.a]\nfile = 'a.csv'\n[wall.w]\nmotion.translate = [{ file = 'b.csv' }]";
        let scene: Table = toml::from_str(scene).unwrap();
        let found: Vec<_> = files(&scene)
            .into_iter()
            .map(|(k, f)| format!("{k}={f}"))
            .collect();
        assert_eq!(
            found,
            [
                "reference.a.file=a.csv",
                "wall.w.motion.translate[0].file=b.csv"
            ]
        );
    }
}
