//! What the documents show is what there is: quoted code, scenes, links.

mod book;
mod crates;
mod dependencies;

use std::path::{Path, PathBuf};

const PLUGINS: &str = include_str!("../../../../docs/plugins.md");
const QUOTED: [&str; 4] = [
    include_str!("../../outside/outside_plugin.rs"),
    include_str!("../../../../examples/syrup/src/lib.rs"),
    include_str!("../../../../examples/tracer/src/lib.rs"),
    include_str!("../../../../examples/winch/src/lib.rs"),
];
const MANIFEST: &str = include_str!("../../../../examples/syrup/Cargo.toml");

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..")
}

/// The documents of the workspace: of its root, of `docs` and its folders, and the README of every
/// crate.
fn documents() -> Vec<(PathBuf, String)> {
    let listed = |folder: PathBuf| {
        let entries = std::fs::read_dir(&folder).unwrap_or_else(|e| panic!("{folder:?}: {e}"));
        entries.map(|e| e.expect("an entry").path())
    };
    let crates = listed(root().join("crates")).map(|folder| folder.join("README.md"));
    let inner = listed(root().join("docs")).filter(|p| p.is_dir());
    let pages = listed(root()).chain(listed(root().join("docs")));
    let pages = pages.chain(inner.flat_map(listed));
    let pages = pages.filter(|p| p.extension().is_some_and(|e| e == "md"));
    let read = |p: PathBuf| {
        let text = std::fs::read_to_string(&p).unwrap_or_else(|e| panic!("{p:?}: {e}"));
        (p, text)
    };
    pages.chain(crates).map(read).collect()
}

/// The code blocks of one language.
fn blocks<'t>(text: &'t str, language: &str) -> Vec<&'t str> {
    let fence = format!("```{language}\n");
    let after = text.split(&fence).skip(1);
    after.map(|t| t.split("```").next().unwrap_or(t)).collect()
}

#[test]
fn the_code_of_the_plugin_page_is_that_of_a_test() {
    let (binary, quoted): (Vec<_>, Vec<_>) = blocks(PLUGINS, "rust")
        .into_iter()
        .partition(|block| block.starts_with("use my_plugins as _;"));
    assert_eq!((binary.len(), quoted.len()), (1, 10));
    for block in quoted {
        let found = QUOTED.iter().any(|file| file.contains(block));
        assert!(found, "in none of the tests and examples:\n{block}");
    }
    let manifests = blocks(PLUGINS, "toml");
    let manifest = manifests.iter().find(|b| b.starts_with("[package]"));
    assert_eq!(manifest, Some(&MANIFEST), "the manifest of the page");
}

#[test]
fn the_code_of_the_page_on_lanes_is_that_of_a_test() {
    let page = include_str!("../../../../docs/lanes.md");
    let test = include_str!("../../outside/lanes.rs");
    let quoted = blocks(page, "rust");
    assert_eq!(quoted.len(), 2);
    for block in quoted {
        assert!(test.contains(block), "not in the test:\n{block}");
    }
}

#[test]
fn every_scene_and_every_study_is_in_its_page() {
    for (folder, page) in [("scenes", "docs/scenes.md"), ("studies", "docs/studies.md")] {
        let page = std::fs::read_to_string(root().join(page)).expect("a page");
        let files = std::fs::read_dir(root().join(folder)).expect("a folder");
        let files = files.map(|f| f.expect("an entry").path());
        for file in files.filter(|p| p.extension().is_some_and(|e| e == "toml")) {
            let name = file.file_name().and_then(|n| n.to_str()).expect("a name");
            let link = format!("{folder}/{name})");
            assert!(page.contains(&link), "{link} is not linked");
        }
    }
}

#[test]
fn every_whole_scene_of_the_documents_can_be_assembled() {
    let mut scenes = 0;
    for (page, text) in documents() {
        for block in blocks(&text, "toml") {
            if block.starts_with("title = ") {
                let loaded = sph_scene::parse(block, "scene.toml", &[]);
                let loaded = loaded.unwrap_or_else(|e| panic!("{page:?}: {e}"));
                let examined = sph_solver::examine(&loaded.scene);
                examined.unwrap_or_else(|e| panic!("{page:?}: {e}"));
                scenes += 1;
            }
        }
    }
    assert!(scenes > 0, "the README shows a scene");
}

#[test]
fn links_within_the_workspace_lead_somewhere() {
    for (page, text) in documents() {
        let folder = page.parent().expect("a folder");
        let targets = text.split("](").skip(1);
        for target in targets.filter_map(|t| t.split([')', '#']).next()) {
            let inside = !target.is_empty() && !target.contains("://");
            assert!(
                !inside || folder.join(target).exists(),
                "{page:?} links to {target}"
            );
        }
    }
}

/// What a scene may name is told once; whoever mentions it leads there.
#[test]
fn pages_agree_on_which_folders_a_scene_may_name() {
    let rule = "validation/stability.md#files-nobody-meant";
    let mut mentioned = 0;
    for (path, text) in documents() {
        if !path.starts_with(root().join("docs")) || path.ends_with("validation/stability.md") {
            continue;
        }
        // A paragraph or an item of a list, with the line ends that wrapping left in it.
        let blocks = text.split("\n\n").flat_map(|block| block.split("\n* "));
        for block in blocks.filter(|b| b.contains("--allow-path")) {
            mentioned += 1;
            assert!(block.contains(rule), "{}: {block}", path.display());
        }
    }
    assert!(mentioned >= 2, "studies and walls mention it");
}
