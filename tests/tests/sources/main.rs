//! What the sources and the pages keep to: arrows between crates and modules, lengths, links, commands.

mod arrows;
mod docs;
mod long_functions;
mod module_circles;
mod ranks;
mod words;

use std::path::{Path, PathBuf};

/// The folder of the workspace.
fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..")
}

/// What a folder holds.
fn listed(folder: &Path) -> Vec<PathBuf> {
    let entries = std::fs::read_dir(folder).unwrap_or_else(|e| panic!("{folder:?}: {e}"));
    entries.map(|e| e.expect("an entry").path()).collect()
}

/// The last part of a path.
fn name(path: &Path) -> &str {
    let name = path.file_name().and_then(|n| n.to_str());
    name.unwrap_or_else(|| panic!("{path:?} has no name"))
}

/// The folders of the crates.
fn crates() -> Vec<PathBuf> {
    listed(&root().join("crates"))
}

/// The sources below a folder, with their text.
fn sources(folder: &Path) -> Vec<(PathBuf, String)> {
    let (mut open, mut found) = (vec![folder.to_path_buf()], Vec::new());
    while let Some(path) = open.pop() {
        if path.is_dir() {
            open.extend(listed(&path));
        } else if path.extension().is_some_and(|e| e == "rs") {
            let text = std::fs::read_to_string(&path).expect("a source");
            found.push((path, text));
        }
    }
    found
}

/// Those of the crates, but for their tests.
fn sources_of_crates() -> impl Iterator<Item = (PathBuf, String)> {
    crates().into_iter().flat_map(|c| sources(&c.join("src")))
}
