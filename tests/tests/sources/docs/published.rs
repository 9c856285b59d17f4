//! Every crate in `crates` is one that can be published: its folder alone has all that its users get.

use std::fs;
use std::path::{Component, Path};

use toml::Table;

use crate::docs::dependencies::{entries, table, workspace};
use crate::{crates, listed, name, root, sources};

fn manifest(folder: &Path) -> Table {
    table(&format!("crates/{}/Cargo.toml", name(folder)))
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
            let whole = text.len() > 100 && (file == "README.md" || same());
            assert!(whole, "{folder:?}: {file}");
        }
    }
}

/// A path alone means nothing to whoever takes a crate from a registry.
#[test]
fn every_crate_of_the_workspace_that_another_depends_on_has_a_version() {
    let shared = entries(&workspace(), "package")["version"].clone();
    let own = entries(&workspace(), "dependencies");
    let own = own.iter().filter(|(_, e)| e.get("path").is_some());
    let own: Vec<_> = own.collect();
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
    let examples = listed(&root().join("examples"));
    others.extend(examples.iter().map(|e| format!("examples/{}", name(e))));
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
        for (source, text) in sources(&folder) {
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
