//! The page on dependencies has what the manifests have, and all of it comes from crates.io.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;

use toml::{Table, Value};

use crate::{name, root};

/// More users than these are `many` on the page.
const NAMED: usize = 4;
const REGISTRY: &str = "registry+https://github.com/rust-lang/crates.io-index";

pub fn table(path: &str) -> Table {
    let text = fs::read_to_string(root().join(path)).unwrap_or_else(|e| panic!("{path}: {e}"));
    text.parse().unwrap_or_else(|e| panic!("{path}: {e}"))
}

/// The entries of a table in a table, empty where there is none.
pub fn entries(table: &Table, name: &str) -> Table {
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
    fn text(&self) -> String {
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
    let folders = crate::crates();
    let folders = folders.iter().map(|f| format!("crates/{}", name(f)));
    let mut folders: Vec<_> = folders.collect();
    folders.extend(["python", "tests"].map(str::to_owned));
    for folder in folders {
        let manifest = table(&format!("{folder}/Cargo.toml"));
        let package = entries(&manifest, "package");
        let name = package["name"].as_str().expect("a name");
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
                    let users = match is_test {
                        true => &mut users.test,
                        false => &mut users.run,
                    };
                    users.insert(name.to_owned());
                }
            }
        };
        add(&manifest);
        entries(&manifest, "target")
            .values()
            .filter_map(Value::as_table)
            .for_each(add);
    }
    let declared = entries(&workspace(), "dependencies");
    let is_own = |name: &str| declared.get(name).is_some_and(|d| d.get("path").is_some());
    used.retain(|name, _| !is_own(name));
    used
}

pub fn workspace() -> Table {
    entries(&table("Cargo.toml"), "workspace")
}

/// What the page says of a crate, in this order, before the last sentences, which tell what else was looked at.
const TOLD: [&str; 4] = [
    ". Used by: ",
    ". Licence: ",
    ". Last release: ",
    ". Instead of: ",
];

/// The items of the page: name, what it does, users, licence, last release, what else was looked at.
fn items() -> BTreeMap<String, Vec<String>> {
    let page = fs::read_to_string(root().join("notes/dependencies.md")).expect("the page");
    let mut found = BTreeMap::new();
    for item in sph_tests::list_items(&page) {
        let Some((name, mut rest)) = item.strip_prefix('`').and_then(|i| i.split_once("`: "))
        else {
            continue;
        };
        let mut told = Vec::new();
        for label in TOLD {
            let (before, after) = rest
                .split_once(label)
                .unwrap_or_else(|| panic!("{name} without{label:?}"));
            told.push(before.to_owned());
            rest = after;
        }
        told.push(rest.to_owned());
        let before = found.insert(name.to_owned(), told);
        assert!(before.is_none(), "two items for {name}");
    }
    found
}

#[test]
fn every_crate_from_outside_has_its_item_and_no_item_is_left_over() {
    let (used, items) = (used(), items());
    let names = |of: &mut dyn Iterator<Item = &String>| of.cloned().collect::<BTreeSet<_>>();
    let (told, found) = (names(&mut items.keys()), names(&mut used.keys()));
    assert_eq!(told, found, "items, manifests");
    for (name, users) in used {
        let told = &items[&name];
        let empty = told.iter().any(|part| part.trim().is_empty());
        assert!(!empty, "something is not told of {name}");
        assert_eq!(told[1], users.text(), "users of {name}");
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
        let digit = begins.is_some_and(|c| c.is_ascii_digit());
        assert!(digit, "version of {name}");
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
