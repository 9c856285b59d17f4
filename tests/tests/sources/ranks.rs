//! Physics knows no ranks: the world sums, and copies of particles follow their owners.

use crate::{crates, name, sources};

/// Crates that divide flows, run their parts, or write a file of each; and `dem-pfv`, which has no `World` and calls cells
/// beyond the hull of its triangulation ghosts.
const KNOWS: [&str; 7] = [
    "dem-pfv",
    "sph-cli",
    "sph-io",
    "sph-neighbours",
    "sph-particles",
    "sph-run",
    "sph-solver",
];

/// Words that no other crate may say, comments included, and what it has instead.
const REFUSED: [(&[&str], &str); 3] = [
    (
        &["rank", "ranks", "communicator", "Communicator"],
        "`World::sums`, `World::largest`, `World::of_all` and `World::space`, which are of all particles",
    ),
    (
        &["ghost", "ghosts"],
        "copies, which `World::owned` leaves out",
    ),
    (
        &["SweepHalf", "sweep_half", "is_wanted"],
        "the executor, which runs sweeps in halves",
    ),
];

/// Refused words in a source, each with its line and what there is instead.
fn refused(text: &str) -> Vec<(usize, String, &'static str)> {
    let mut found = Vec::new();
    for (k, line) in text.lines().enumerate() {
        for word in line.split(|c: char| !(c.is_alphanumeric() || c == '_')) {
            let of = REFUSED.iter().find(|(words, _)| words.contains(&word));
            found.extend(of.map(|(_, instead)| (k + 1, word.to_string(), *instead)));
        }
    }
    found
}

#[test]
fn no_physics_names_a_rank() {
    let mut crates = crates();
    crates.retain(|path| !KNOWS.contains(&name(path)));
    let (mut lines, mut found) = (0, Vec::new());
    for (path, text) in crates.iter().flat_map(|path| sources(&path.join("src"))) {
        lines += text.lines().count();
        let file = path.display();
        for (line, word, instead) in refused(&text) {
            found.push(format!("{file}:{line}: `{word}`; there is {instead}"));
        }
    }
    assert!(lines > 50_000, "only {lines} lines were read");
    found.sort();
    assert!(found.is_empty(), "{}", found.join("\n"));
}

#[test]
fn a_word_is_refused_as_a_whole() {
    let text = "let low = LowRank { base };\n// On all ranks.\nif let Some(communicator) = &world.communicator {}\n";
    let found = refused(text)
        .into_iter()
        .map(|(line, word, _)| (line, word));
    let expected = [(2, "ranks"), (3, "communicator"), (3, "communicator")];
    assert!(found.eq(expected.map(|(line, word)| (line, word.to_string()))));
}
