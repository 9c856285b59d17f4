//! The list of the project's crates in `docs/architecture.md` has their arrows.

use std::collections::{BTreeMap, BTreeSet};

use crate::docs::dependencies::{entries, table, workspace};
use crate::{name, root};
use sph_tests::list_items;

/// The crates in `crates` and those of the project that each is built on, as a page writes them.
fn arrows() -> BTreeMap<String, String> {
    let own: BTreeSet<String> = entries(&workspace(), "dependencies")
        .into_iter()
        .filter(|(_, entry)| entry.get("path").is_some())
        .map(|(name, _)| name)
        .collect();
    let names = crate::crates().into_iter().map(|c| name(&c).to_string());
    let arrows = names.map(|name| {
        let manifest = table(&format!("crates/{name}/Cargo.toml"));
        let used = entries(&manifest, "dependencies");
        let used: BTreeSet<String> = used.into_iter().map(|(name, _)| name).collect();
        let used: Vec<String> = used.intersection(&own).cloned().collect();
        let told = match used.is_empty() {
            true => "none".to_owned(),
            false => used.join(", "),
        };
        (name, told)
    });
    arrows.collect()
}

#[test]
fn the_list_of_crates_has_all_of_them_with_their_arrows() {
    let page = std::fs::read_to_string(root().join("docs/architecture.md")).expect("the page");
    let told = list_items(&page).into_iter().filter_map(|item| {
        let name = item.strip_prefix("[`")?.split('`').next()?.to_owned();
        let (_, used) = item.split_once(" Uses: ")?;
        Some((name, used.trim_end_matches('.').to_owned()))
    });
    let told: BTreeMap<String, String> = told.collect();
    assert_eq!(told, arrows(), "docs/architecture.md, the manifests");
}
