//! The files of a run, with their purposes.

use std::path::Path;

use serde_json::Value as Json;
use sph_run::SUMMARY;

use crate::terminal::shell::quoted;
use crate::terminal::{columns, row};

/// Known files, in the order of their use.
const KNOWN: [(&str, &str); 4] = [
    ("fields.pvd", "fields over time: open it in ParaView"),
    ("series.csv", "time series: energies, extrema, probes"),
    ("summary.json", "all of the above and more, for scripts"),
    ("checkpoint.sph", "the last state, for --resume"),
];

/// The last lines of a run: its files, and the command that shows them.
pub fn ending(folder: &Path) -> String {
    let shown = folder.display().to_string();
    let (files, word) = (columns(2, listing(folder)), quoted(&shown));
    format!("written to {shown}\n{files}look at it: sph view {word}\n")
}

fn listing(folder: &Path) -> Vec<Vec<String>> {
    let mut rows = Vec::new();
    for (sub, extension, one, many) in [
        ("pictures", "png", "a picture", "pictures"),
        (
            "animations",
            "gif",
            "the pictures one after the other",
            "animations",
        ),
        (
            "plots",
            "png",
            "a probe beside its reference",
            "probes beside their references",
        ),
    ] {
        let mut files = names(&folder.join(sub), extension);
        files.sort();
        match files.as_slice() {
            [] => {}
            [only] => rows.push(row(&format!("{sub}/{only}"), one)),
            [first, .., last] => {
                let count = format!("{} {many}", files.len());
                rows.push(row(&format!("{sub}/{first} … {last}"), count));
            }
        }
    }
    let present = KNOWN.iter().filter(|(name, _)| folder.join(name).exists());
    rows.extend(present.map(|(name, what)| row(name, *what)));
    rows
}

pub fn read_summary(folder: &Path) -> Option<Json> {
    serde_json::from_str(&std::fs::read_to_string(folder.join(SUMMARY)).ok()?).ok()
}

/// Names of the files of a kind in a folder, in the order of their numbers.
pub fn names(folder: &Path, extension: &str) -> Vec<String> {
    let entries = std::fs::read_dir(folder).into_iter().flatten().flatten();
    let names = entries.filter_map(|e| e.file_name().into_string().ok());
    let of_kind = |name: &String| Path::new(name).extension().is_some_and(|e| e == extension);
    let mut names: Vec<String> = names.filter(of_kind).collect();
    names.sort_by_key(|n| (n.len(), n.clone()));
    names
}
