//! The page on dependencies has what the manifests have, and all of it comes from crates.io.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;

use toml::{Table, Value};

use crate::root;

/// More users than these are `many` on the page.
const NAMED: usize = 4;
const REGISTRY: &str = "registry+https://github.com/rust-lang/crates.io-index";

fn table(path: &str) -> Table {
    let text = fs::read_to_string(root().join(path)).unwrap_or_else(|e| panic!("{path}: {e}"));
    text.parse().unwrap_or_else(|e| panic!("{path}: {e}"))
}

/// The entries of a table in a table, empty where there is none.
fn entries(table: &Table, name: &str) -> Table {
    let entries = table.get(name).and_then(Value::as_table);
    entries.cloned().unwrap_or_default()
}

/// Who uses a crate: to run, and to test only.
#[derive(Default)]
struct Users {
    run: BTreeSet<String>,
    test: BTreeSet<String>,
}

impl Users {
    /// As the page writes them.
    fn told(&self) -> String {
        let named = |of: &BTreeSet<String>| of.iter().cloned().collect::<Vec<_>>().join(", ");
        let tests: BTreeSet<String> = self.test.difference(&self.run).cloned().collect();
        match (self.run.len(), tests.len()) {
            (run, test) if run.max(test) > NAMED => "many".to_owned(),
            (_, 0) => named(&self.run),
            (0, _) => named(&tests),
            _ => format!("{} ({})", named(&self.run), named(&tests)),
        }
    }
}

/// All crates from outside that a manifest of the workspace names.
fn used() -> BTreeMap<String, Users> {
    let mut used: BTreeMap<String, Users> = BTreeMap::new();
    let folders = fs::read_dir(root().join("crates")).expect("a folder");
    let folders = folders.map(|f| f.expect("an entry").file_name());
    let mut folders: Vec<_> = folders
        .map(|f| format!("crates/{}", f.to_str().expect("a name")))
        .collect();
    folders.extend(["python", "tests"].map(str::to_owned));
    for folder in folders {
        let manifest = table(&format!("{folder}/Cargo.toml"));
        let name = entries(&manifest, "package")["name"]
            .as_str()
            .map(str::to_owned);
        let name = name.expect("a name");
        let mut add = |of: &Table| {
            for (key, is_test) in [
                ("dependencies", false),
                ("build-dependencies", false),
                ("dev-dependencies", true),
            ] {
                // What has a path is of this project.
                let all = entries(of, key);
                let outside = all.iter().filter(|(_, entry)| entry.get("path").is_none());
                for (dependency, _) in outside {
                    let users = used.entry(dependency.clone()).or_default();
                    let users = if is_test {
                        &mut users.test
                    } else {
                        &mut users.run
                    };
                    users.insert(name.clone());
                }
            }
        };
        add(&manifest);
        entries(&manifest, "target")
            .values()
            .filter_map(Value::as_table)
            .for_each(add);
    }
    let own: Vec<_> = entries(&workspace(), "dependencies")
        .into_iter()
        .filter(|(_, entry)| entry.get("path").is_some())
        .collect();
    used.retain(|name, _| !own.iter().any(|(n, _)| n == name));
    used
}

fn workspace() -> Table {
    entries(&table("Cargo.toml"), "workspace")
}

/// The rows of the page: name, and the cells after it.
fn rows() -> BTreeMap<String, Vec<String>> {
    let page = fs::read_to_string(root().join("docs/dependencies.md")).expect("the page");
    let rows = page.lines().filter_map(|line| {
        let row = line.strip_prefix("| `")?.strip_suffix(" |")?;
        let (name, rest) = row.split_once("` | ")?;
        Some((
            name.to_owned(),
            rest.split(" | ").map(str::to_owned).collect(),
        ))
    });
    let mut found = BTreeMap::new();
    for (name, cells) in rows {
        assert!(
            found.insert(name.clone(), cells).is_none(),
            "two rows for {name}"
        );
    }
    found
}

#[test]
fn every_crate_from_outside_has_its_row_and_no_row_is_left_over() {
    let (used, rows) = (used(), rows());
    let names = |of: &mut dyn Iterator<Item = &String>| of.cloned().collect::<BTreeSet<_>>();
    assert_eq!(
        names(&mut rows.keys()),
        names(&mut used.keys()),
        "rows, manifests"
    );
    for (name, users) in used {
        let cells = &rows[&name];
        assert_eq!(cells.len(), 5, "cells of {name}");
        assert!(
            cells.iter().all(|cell| !cell.trim().is_empty()),
            "empty cells of {name}"
        );
        assert_eq!(cells[1], users.told(), "users of {name}");
    }
}

/// A dependency that is declared for all and taken by nobody is litter, and one without a version takes any.
#[test]
fn every_crate_that_the_workspace_declares_has_a_version_and_a_user() {
    let used = used();
    for (name, entry) in entries(&workspace(), "dependencies") {
        if entry.get("path").is_some() {
            continue;
        }
        let version = entry.as_str().or_else(|| entry.get("version")?.as_str());
        let begins = version.and_then(|v| v.chars().next());
        assert!(
            begins.is_some_and(|c| c.is_ascii_digit()),
            "version of {name}"
        );
        assert!(used.contains_key(&name), "nobody uses {name}");
    }
}

#[test]
fn all_that_is_locked_comes_from_the_registry() {
    let lock = table("Cargo.lock");
    let packages = lock["package"].as_array().expect("packages");
    for package in packages.iter().filter_map(Value::as_table) {
        // Packages without a source are those of the workspace.
        if let Some(source) = package.get("source") {
            assert_eq!(source.as_str(), Some(REGISTRY), "{}", package["name"]);
            assert!(package.contains_key("checksum"), "{}", package["name"]);
        }
    }
}
