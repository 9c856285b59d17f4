//! All inputs of a variant's result, as one short text.

use toml::Table;

/// Version of the program, part of every fingerprint.
pub const VERSION: &str = env!("CARGO_PKG_VERSION");

/// A fingerprint of a resolved scene, the content of its data files by their keys, and the program's version.
///
/// Titles and descriptions do not count.
pub fn fingerprint(mut scene: Table, marks: &[(String, String)]) -> String {
    scene.remove("title");
    scene.remove("description");
    let mut text = format!(
        "sph {VERSION}\n{}",
        toml::to_string(&scene).unwrap_or_default()
    );
    for (key, content) in marks {
        text.push_str(&format!("{key} {content}\n"));
    }
    format!("{:08x}-{}", crc32fast::hash(text.as_bytes()), text.len())
}
