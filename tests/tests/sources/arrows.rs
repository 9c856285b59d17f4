//! Crates are rooms with one-way doors.

use std::collections::{BTreeMap, BTreeSet};
use std::process::Command;

use serde_json::Value;
use sph_core::kinds;

use crate::{root, sources};

/// What a crate of the workspace may depend on within it; the tests may everything.
const ALLOWED: &str = "
    sparse:
    sph-soil: sph-core sph-neighbours sph-rheology sph-contribution sph-multiphase
    dem-pfv: sparse scene-text sph-core sph-io sph-run
    scene-text:
    sph-kernels:
    sph-derive:
    sph-core: scene-text sph-derive
    sph-neighbours: sph-core sph-derive sph-kernels
    sph-boundary: sph-core sph-kernels sph-neighbours
    sph-open: sph-core sph-kernels sph-neighbours sph-boundary sph-rheology sph-contribution sph-probes
    sph-rheology: sph-core sph-derive
    sph-contribution: sph-core sph-neighbours sph-rheology
    sph-multiphase: sph-core sph-neighbours sph-rheology sph-contribution sph-kernels sparse
    sph-probes: sph-core sph-kernels sph-neighbours
    sph-io: sph-core
    sph-turbulence: sph-core sph-kernels sph-neighbours sph-contribution sph-multiphase sph-soil sph-probes
    sph-scene: scene-text sph-core
    sph-particles: sph-boundary sph-contribution sph-core sph-neighbours sph-io sph-probes sph-run sph-scene \
        sph-solver sph-multiphase sph-kernels sph-open sph-rheology
    sph-run: scene-text sph-io
    sph-study: sph-core sph-io sph-run sph-scene
    sph-cli: dem-pfv sph-core sph-multiphase sph-neighbours sph-io sph-particles sph-probes sph-run \
        sph-scene sph-solver sph-study sph-turbulence sph-open
    sph-python: sph-cli sph-contribution sph-core sph-io sph-neighbours sph-particles sph-probes sph-run sph-solver
";

/// From the plugins of a scene to its run.
const SOLVERS: [&str; 2] = ["sph-solver", "sph-particles"];

/// Heavy crates, each with the crates that may name it.
const KEPT_IN: [(&str, &[&str]); 7] = [
    ("pyo3", &["sph-python"]),
    ("numpy", &["sph-python"]),
    ("clap", &["sph-cli"]),
    ("ariadne", &["sph-cli"]),
    ("indicatif", &["sph-cli"]),
    ("faer", &["sparse"]),
    ("hdf5", &["sph-io"]),
];

#[derive(Default)]
struct Room {
    /// Normal and build dependencies.
    uses: BTreeSet<String>,
    /// Those of its tests and benches.
    tests_use: BTreeSet<String>,
}

/// What `cargo` says.
fn cargo(words: &str) -> String {
    let mut command = Command::new(env!("CARGO"));
    command.args(words.split(' ')).current_dir(root());
    let output = command.output().expect("cargo");
    let error = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{words}: {error}");
    String::from_utf8(output.stdout).expect("a text")
}

fn packages() -> Vec<Value> {
    let told = cargo("metadata --no-deps --offline --format-version 1");
    let metadata: Value = serde_json::from_str(&told).expect("JSON");
    metadata["packages"].as_array().expect("packages").clone()
}

fn rooms() -> BTreeMap<String, Room> {
    let text = |v: &Value| v.as_str().unwrap_or_default().to_string();
    let mut rooms: BTreeMap<String, Room> = BTreeMap::new();
    for package in packages() {
        let room = rooms.entry(text(&package["name"])).or_default();
        for dependency in package["dependencies"].as_array().into_iter().flatten() {
            let name = text(&dependency["name"]);
            match dependency["kind"].as_str() {
                Some("dev") => room.tests_use.insert(name),
                _ => room.uses.insert(name),
            };
        }
    }
    rooms
}

#[test]
fn every_dependency_within_the_workspace_is_an_arrow_of_the_design() {
    let rooms = rooms();
    assert!(rooms.contains_key("sph-solver") && rooms.contains_key("sph-tests"));
    let allowed: BTreeMap<_, _> = ALLOWED
        .lines()
        .filter_map(|l| l.trim().split_once(':'))
        .collect();
    for (name, room) in &rooms {
        let own = room.uses.iter().filter(|d| rooms.contains_key(*d));
        let allowed = allowed.get(name.as_str());
        for target in own {
            let fine = match (name.as_str(), allowed) {
                ("sph-tests", _) => true,
                // Examples stand for crates of strangers.
                ("artificial-viscosity" | "syrup" | "tracer" | "winch", _) => {
                    !SOLVERS.contains(&target.as_str())
                }
                ("embedding" | "embedding-bare", _) => true,
                ("sph-solver", _) => !["sph-particles", "sph-study", "sph-cli", "sph-tests"]
                    .contains(&target.as_str()),
                (_, Some(allowed)) => allowed.split(' ').any(|a| a == target),
                (_, None) => target == "sph-core",
            };
            assert!(fine, "{name} must not depend on {target}");
        }
    }
}

#[test]
fn nothing_but_studies_the_command_line_python_tests_examples_and_benches_knows_the_solver() {
    for (name, room) in rooms() {
        let all = || room.uses.union(&room.tests_use);
        let knows = all().find(|d| SOLVERS.contains(&d.as_str()));
        let may = "sph-particles sph-study sph-cli sph-python sph-tests embedding";
        let may = may.split(' ').any(|m| m == name);
        assert!(knows.is_none() || may, "{name} depends on {knows:?}");
    }
}

/// `sph-io` writes files, `sph-run` drives any model and `sph-core` registers plugins; they compute no particles.
#[test]
fn grains_know_no_particles() {
    for (name, room) in rooms() {
        let known = room.uses.union(&room.tests_use).find(|d| {
            d.starts_with("sph-") && !["sph-io", "sph-run", "sph-core"].contains(&d.as_str())
        });
        let apart = !name.starts_with("dem-") || known.is_none();
        assert!(apart, "{name} depends on {known:?}");
    }
}

#[test]
fn crates_that_can_be_used_alone_are_tested_alone() {
    for name in "sph-kernels sph-core sph-rheology sph-io dem-pfv".split(' ') {
        let room = &rooms()[name];
        let others = room.tests_use.iter().filter(|d| d.starts_with("sph-"));
        let others: Vec<_> = others.filter(|d| *d != "sph-core").collect();
        assert!(others.is_empty(), "the tests of {name} need {others:?}");
    }
}

/// What a program takes along that embeds a crate without its plugins, and how many crates of others that may be.
const EMBEDDED: [(&str, usize); 3] = [
    ("sph-kernels", 0),
    ("sph-rheology", 10),
    ("sph-boundary", 25),
];

#[test]
fn a_crate_without_its_plugins_brings_few_others_along() {
    for (name, most) in EMBEDDED {
        let told = cargo(&format!(
            "tree --offline --package {name} --no-default-features --edges normal --prefix none"
        ));
        assert!(told.starts_with(name), "{told}");
        // Those of the workspace have a path behind their version.
        let others = told.lines().filter(|line| !line.contains(" (/"));
        let others: BTreeSet<&str> = others.filter_map(|l| l.split(' ').next()).collect();
        let count = others.len();
        assert!(count <= most, "{name} brings {count}: {others:?}");
    }
}

#[test]
fn heavy_crates_stay_in_their_room() {
    for (name, room) in rooms() {
        for (heavy, home) in KEPT_IN {
            let knows = room.uses.contains(heavy) || room.tests_use.contains(heavy);
            let may = !knows || home.contains(&name.as_str());
            assert!(may, "{name} depends on {heavy} of {home:?}");
        }
    }
}

/// Each links the crates that it tests once more.
#[test]
fn test_binaries_are_at_most_twenty() {
    let packages = packages();
    let targets = packages.iter().flat_map(|p| p["targets"].as_array());
    let tests = targets.flatten().filter(|t| t["kind"][0] == "test");
    let names: Vec<_> = tests.filter_map(|t| t["name"].as_str()).collect();
    let count = names.len();
    assert!((10..=20).contains(&count), "{count}: {names:?}");
}

/// The solver assembles what scenes name; kinds have the names that its messages advise.
#[test]
fn no_plugin_is_named_in_the_solver_and_kinds_advise_plugins_that_there_are() {
    let folders = SOLVERS.map(|name| root().join("crates").join(name).join("src"));
    for kind in kinds() {
        let names: Vec<_> = (kind.plugins)().iter().map(|plugin| plugin.name).collect();
        let advised = kind.advised.is_none_or(|name| names.contains(&name));
        assert!(
            advised,
            "{} advises {:?} of {names:?}",
            kind.name, kind.advised
        );
    }
    let sources = folders.iter().flat_map(|folder| sources(folder));
    let mut named = Vec::new();
    let mut lines = 0;
    for (path, text) in sources {
        // Tests may run scenes.
        let code = text.split("#[cfg(test)]").next().unwrap_or_default();
        lines += code.lines().count();
        for kind in kinds() {
            for plugin in (kind.plugins)() {
                let kind = kind.name;
                let alone = format!("\"{}\"", plugin.name);
                let in_table = format!("{kind}.{}", plugin.name);
                // Names of one common word are names of other things, too.
                let telling = plugin.name.contains('-') && code.contains(&alone);
                if telling || code.contains(&in_table) {
                    named.push(format!("{}: {in_table}", path.display()));
                }
            }
        }
    }
    assert!(lines > 4000, "only {lines} lines were read");
    assert!(named.is_empty(), "{named:#?}");
}
