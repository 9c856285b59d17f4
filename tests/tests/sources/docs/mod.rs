//! What the documents show is what there is: quoted code, scenes, links.

mod book;
mod crates;
mod dependencies;
mod keys;
mod published;

use std::path::PathBuf;

use crate::{listed, name, root};
use {artificial_viscosity as _, sph_cli as _, syrup as _, tracer as _};

const PLUGINS: &str = include_str!("../../../../docs/plugins.md");
const QUOTED: [&str; 5] = [
    LANES,
    include_str!("../../../../examples/artificial-viscosity/examples/sph.rs"),
    include_str!("../../../../examples/syrup/src/lib.rs"),
    include_str!("../../../../examples/syrup/src/powell_eyring.rs"),
    include_str!("../../../../examples/tracer/src/lib.rs"),
];
const LANES: &str = include_str!("../../../../examples/artificial-viscosity/src/lib.rs");
const MANIFEST: &str = include_str!("../../../../examples/syrup/Cargo.toml");

/// The documents of the workspace: of its root, of `docs` and its folders, and the README of every
/// crate.
pub(crate) fn documents() -> Vec<(PathBuf, String)> {
    let docs = listed(&root().join("docs"));
    let inner = docs.iter().filter(|p| p.is_dir()).flat_map(|p| listed(p));
    let mut pages = [listed(&root()), inner.collect(), docs.clone()].concat();
    pages.retain(|p| p.extension().is_some_and(|e| e == "md"));
    pages.extend(crate::crates().iter().map(|c| c.join("README.md")));
    let read = |p: PathBuf| {
        let text = std::fs::read_to_string(&p).unwrap_or_else(|e| panic!("{p:?}: {e}"));
        (p, text)
    };
    pages.into_iter().map(read).collect()
}

/// The code blocks of one language.
fn blocks<'t>(text: &'t str, language: &str) -> Vec<&'t str> {
    let fence = format!("```{language}\n");
    let after = text.split(&fence).skip(1);
    after.map(|t| t.split("```").next().unwrap_or(t)).collect()
}

#[test]
fn the_code_of_the_plugin_page_is_that_of_the_examples() {
    let quoted = blocks(PLUGINS, "rust");
    assert_eq!(quoted.len(), 7);
    for block in &quoted {
        let found = QUOTED.iter().any(|file| file.contains(block));
        assert!(found, "in none of the examples:\n{block}");
    }
    assert_eq!(PLUGINS.matches("```").count() / 2, quoted.len() + 4);
}

/// Manifests: that of the syrup, and that of a stranger's program with the profile and the paths of this workspace.
#[test]
fn the_manifests_of_the_plugin_page_are_those_of_the_workspace() {
    let mut manifests = blocks(PLUGINS, "toml");
    manifests.retain(|b| b.starts_with("[package]"));
    let [syrup, program] = manifests[..] else {
        panic!("{} manifests", manifests.len());
    };
    assert_eq!(syrup, MANIFEST);
    let own = std::fs::read_to_string(root().join("Cargo.toml")).expect("a manifest");
    let table = |text: &str| text.parse::<toml::Table>().expect("TOML");
    let (program, own) = (table(program), table(&own));
    for key in ["opt-level", "lto", "codegen-units"] {
        let of = |manifest: &toml::Table| manifest["profile"]["release"].get(key).cloned();
        assert_eq!(of(&program), of(&own), "{key}");
    }
    for (name, dependency) in program["dependencies"].as_table().expect("a table") {
        let path = dependency["path"].as_str().expect("a path");
        let path = path.strip_prefix("../sph/").expect("a clone called sph");
        let manifest = root().join(path).join("Cargo.toml");
        let manifest = table(&std::fs::read_to_string(&manifest).expect("a crate"));
        assert_eq!(manifest["package"]["name"].as_str(), Some(name.as_str()));
    }
}

/// Parts of scenes: each is one plugin or more, with parameters that it takes.
#[test]
fn the_scenes_of_the_plugin_page_name_plugins_with_their_parameters() {
    let mut checked = 0;
    for block in blocks(PLUGINS, "toml") {
        let table: toml::Table = block.parse().expect("TOML");
        let phases = table.get("phase").and_then(toml::Value::as_table);
        let laws = phases.into_iter().flat_map(|all| all.values());
        let laws = laws.filter_map(toml::Value::as_table);
        let kinds = std::iter::once(&table).chain(laws).flatten();
        for (kind, plugins) in kinds {
            let Some(kind) = sph_core::kind_of(kind) else {
                continue;
            };
            for (name, keys) in plugins.as_table().expect("a table") {
                let all = (kind.plugins)();
                let plugin = all.iter().find(|p| p.name == name).expect("a plugin");
                let conforms = sph_core::conform(&mut keys.clone(), &(plugin.schema)());
                assert_eq!(conforms, Ok(vec![]), "{name}");
                checked += 1;
            }
        }
    }
    assert_eq!(checked, 3);
}

/// The kinds of particles are all that are registered, those of grains are in a list of the command line.
#[test]
fn the_plugin_page_has_a_row_for_every_kind() {
    let own = sph_core::kinds().into_iter().map(|kind| kind.name);
    let grains = ["conductance", "contact-law"];
    let kinds: Vec<_> = own.chain(grains).filter(|k| *k != "tracer").collect();
    assert!(kinds.len() > 28, "{kinds:?}");
    for kind in kinds {
        let row = format!("\n| `{kind}` | `");
        assert_eq!(PLUGINS.matches(&row).count(), 1, "{kind}");
    }
}

#[test]
fn the_code_of_the_page_on_lanes_is_that_of_an_example() {
    let page = include_str!("../../../../docs/lanes.md");
    let quoted = blocks(page, "rust");
    assert_eq!(quoted.len(), 1);
    for block in quoted {
        assert!(LANES.contains(block), "not in the example:\n{block}");
    }
}

#[test]
fn every_scene_and_every_study_is_in_its_page() {
    for (folder, page) in [
        ("scenes", "docs/gallery.md"),
        ("studies", "docs/studies.md"),
    ] {
        let page = std::fs::read_to_string(root().join(page)).expect("a page");
        let mut files = listed(&root().join(folder));
        files.retain(|p| p.extension().is_some_and(|e| e == "toml"));
        for file in files {
            let link = format!("{folder}/{})", name(&file));
            assert!(page.contains(&link), "{link} is not linked");
        }
    }
}

#[test]
fn every_scene_has_a_small_picture() {
    let mut all = 0;
    for path in listed(&root().join("docs/images/scenes")) {
        let size = path.metadata().expect("a file").len();
        all += size;
        let name = path.file_stem().and_then(|n| n.to_str()).expect("a name");
        let scene = root().join(format!("scenes/{name}.toml"));
        assert!(scene.is_file(), "{path:?} is of no scene");
        assert!(size < 20_000, "{path:?}: {size} bytes");
    }
    assert!(all < 1_500_000, "{all} bytes of all scenes");
}

#[test]
fn every_whole_scene_of_the_documents_can_be_assembled() {
    let mut scenes = 0;
    for (page, text) in documents() {
        for block in blocks(&text, "toml") {
            if block.starts_with("title = ") {
                let loaded = sph_scene::parse(block, "scene.toml", &[]);
                let loaded = loaded.unwrap_or_else(|e| panic!("{page:?}: {e}"));
                let examined = sph_particles::setup::examine(&loaded.scene);
                examined.unwrap_or_else(|e| panic!("{page:?}: {e}"));
                scenes += 1;
            }
        }
    }
    assert!(scenes > 0, "a tutorial shows a scene");
}

#[test]
fn links_within_the_workspace_lead_somewhere() {
    for (page, text) in documents() {
        let folder = page.parent().expect("a folder");
        let targets = text.split("](").skip(1);
        for target in targets.filter_map(|t| t.split([')', '#']).next()) {
            let inside = !target.is_empty() && !target.contains("://");
            let found = !inside || folder.join(target).exists();
            assert!(found, "{page:?} links to {target}");
        }
    }
}

/// What a scene may name is told once; whoever mentions it leads there.
#[test]
fn pages_agree_on_which_folders_a_scene_may_name() {
    let rule = "validation/stability.md#files-of-a-scene";
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
