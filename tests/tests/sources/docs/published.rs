//! Every crate in `crates` is one that can be published: its folder alone has all that its users get.

use std::fs;
use std::path::{Component, Path, PathBuf};

use toml::Table;

use crate::docs::dependencies::{entries, table, workspace};
use crate::docs::root;

fn crates() -> Vec<PathBuf> {
    let folders = fs::read_dir(root().join("crates")).expect("a folder");
    folders.map(|f| f.expect("an entry").path()).collect()
}

fn manifest(folder: &Path) -> Table {
    let name = folder.file_name().and_then(|n| n.to_str());
    table(&format!("crates/{}/Cargo.toml", name.expect("a name")))
}

/// Sources of a folder and of those within it.
fn sources(folder: &Path) -> Vec<PathBuf> {
    let (mut found, mut folders) = (Vec::new(), vec![folder.to_path_buf()]);
    while let Some(folder) = folders.pop() {
        for entry in fs::read_dir(&folder).expect("a folder") {
            let path = entry.expect("an entry").path();
            match path.is_dir() {
                true => folders.push(path),
                false if path.extension().is_some_and(|e| e == "rs") => found.push(path),
                false => {}
            }
        }
    }
    found
}

/// How many folders above the first one a path leads at most.
fn highest(path: &Path) -> usize {
    let (mut depth, mut highest) = (0_i32, 0);
    for part in path.components() {
        depth += match part {
            Component::ParentDir => -1,
            Component::Normal(_) => 1,
            _ => 0,
        };
        highest = highest.min(depth);
    }
    highest.unsigned_abs() as usize
}

#[test]
fn every_crate_says_what_a_registry_asks_for_and_has_its_licences() {
    let asked = [
        "description",
        "version",
        "license",
        "keywords",
        "categories",
        "rust-version",
    ];
    for folder in crates() {
        let package = entries(&manifest(&folder), "package");
        for key in asked {
            assert!(package.contains_key(key), "{folder:?} without {key}");
        }
        for file in ["README.md", "LICENSE-APACHE", "LICENSE-MIT"] {
            let text = fs::read_to_string(folder.join(file)).unwrap_or_default();
            let shared = root().join(file);
            let same = || fs::read_to_string(&shared).expect("a licence") == text;
            assert!(
                text.len() > 100 && (file == "README.md" || same()),
                "{folder:?}: {file}"
            );
        }
    }
}

/// A path alone means nothing to whoever takes a crate from a registry.
#[test]
fn every_crate_of_the_workspace_that_another_depends_on_has_a_version() {
    let shared = entries(&workspace(), "package")["version"].clone();
    let own = entries(&workspace(), "dependencies");
    let own: Vec<_> = own
        .iter()
        .filter(|(_, e)| e.get("path").is_some())
        .collect();
    assert_eq!(own.len(), crates().len());
    for (name, entry) in own {
        assert_eq!(entry.get("version"), Some(&shared), "{name}");
    }
    for folder in crates() {
        for (name, entry) in entries(&manifest(&folder), "dependencies") {
            let bare = entry.get("path").is_some() && entry.get("version").is_none();
            assert!(!bare, "{folder:?}: {name} by its path alone");
        }
    }
}

#[test]
fn what_is_no_crate_for_others_is_never_published() {
    let mut others = vec!["python".to_owned(), "tests".into(), "fuzz".into()];
    let examples = fs::read_dir(root().join("examples")).expect("a folder");
    let names = examples.map(|e| e.expect("an entry").file_name());
    others.extend(names.map(|n| format!("examples/{}", n.to_str().expect("a name"))));
    for folder in others {
        let package = entries(&table(&format!("{folder}/Cargo.toml")), "package");
        let publish = package.get("publish").and_then(toml::Value::as_bool);
        assert_eq!(publish, Some(false), "{folder}");
    }
}

/// On docs.rs and crates.io there is no repository around a page.
#[test]
fn no_page_of_a_crate_leads_out_of_it() {
    for folder in crates() {
        let page = fs::read_to_string(folder.join("README.md")).expect("a page");
        for target in page.split("](").skip(1).filter_map(|t| t.split(')').next()) {
            let near = target.starts_with('#') || target.contains("://");
            assert!(near, "{folder:?}: README.md links to {target}");
        }
    }
}

/// A package holds the files of its folder; what is compiled in from elsewhere is missing there.
#[test]
fn no_source_takes_in_a_file_from_outside_of_its_crate() {
    let mut checked = 0;
    for folder in crates() {
        for source in sources(&folder) {
            let text = fs::read_to_string(&source).expect("a source");
            let inside = source.strip_prefix(&folder).expect("it is inside");
            let depth = inside.components().count() - 1;
            for macro_name in ["include_str!(\"", "include_bytes!(\"", "#[path = \""] {
                let each = text.split(macro_name).skip(1);
                for path in each.filter_map(|t| t.split('"').next()) {
                    let above = highest(Path::new(path));
                    assert!(above <= depth, "{}: {path}", source.display());
                    checked += 1;
                }
            }
        }
    }
    assert!(checked > 15, "{checked} files");
}
