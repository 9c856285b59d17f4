//! All that a run leaves behind, to be compared with what another one left.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use serde_json::Value as Json;
use sph_io::Checkpoint;

use crate::{FinalState, files_with_extension};

/// A results folder, less what clocks on the wall say.
#[derive(Debug, PartialEq)]
pub struct Results {
    /// State, series and fields.
    pub state: FinalState,
    /// Pictures, curves and lists, by name.
    pub files: BTreeMap<PathBuf, Vec<u8>>,
    /// `summary.json`.
    pub summary: Json,
    /// What the checkpoint says of the run.
    pub counters: Json,
}

/// Entries that depend on the machine.
const CLOCKS: [&str; 6] = [
    "wall_seconds",
    "wall_seconds_by_stage",
    "stage_seconds",
    "threads",
    "particle_steps_per_second",
    "nanoseconds_per_pair",
];

impl Results {
    /// Reads a results folder.
    pub fn read(folder: &Path) -> Self {
        let summary = std::fs::read(folder.join("summary.json")).expect("a summary");
        let summary = serde_json::from_slice(&summary).expect("a whole summary");
        let checkpoint = Checkpoint::load(folder.join("checkpoint.sph")).expect("a checkpoint");
        let kinds = ["png", "csv", "pvd"].into_iter();
        let files = kinds.flat_map(|kind| files_with_extension(folder, kind));
        let named = |path: PathBuf| {
            let name = path.strip_prefix(folder).expect("below the folder");
            let name = name.to_path_buf();
            (name, std::fs::read(path).expect("a file"))
        };
        Results {
            state: FinalState::read(folder),
            files: files.map(named).collect(),
            summary: timeless(summary),
            counters: timeless(checkpoint.meta["run"].clone()),
        }
    }

    /// Steps of the run.
    pub fn steps(&self) -> u64 {
        self.summary["steps"].as_u64().expect("a number of steps")
    }

    /// Fails with the name of what differs.
    pub fn assert_same(&self, other: &Self, what: &str) {
        self.state.assert_same(&other.state, what);
        let names = |r: &Self| r.files.keys().cloned().collect::<Vec<_>>();
        assert_eq!(names(self), names(other), "{what}: files");
        for (name, bytes) in &self.files {
            let same = *bytes == other.files[name];
            assert!(same, "{what}: {} differs", name.display());
        }
        assert_entries(&self.summary, &other.summary, &format!("{what}: summary"));
        assert_entries(
            &self.counters,
            &other.counters,
            &format!("{what}: counters"),
        );
    }
}

fn assert_entries(a: &Json, b: &Json, what: &str) {
    let keys = |json: &Json| {
        json.as_object()
            .map(|o| o.keys().cloned().collect::<Vec<_>>())
    };
    assert_eq!(keys(a), keys(b), "{what}");
    for key in keys(a).into_iter().flatten() {
        assert_eq!(a[&key], b[&key], "{what}: {key}");
    }
}

/// Without what the machine has a say in.
fn timeless(mut json: Json) -> Json {
    let entries = json.as_object_mut().expect("a table");
    entries.retain(|key, _| !CLOCKS.contains(&key.as_str()));
    let solves = entries.get_mut("implicit_viscosity");
    if let Some(inner) = solves.and_then(Json::as_object_mut) {
        inner.retain(|key, _| !CLOCKS.contains(&key.as_str()));
    }
    let works = entries.get_mut("works").and_then(Json::as_object_mut);
    for counted in works.into_iter().flat_map(|works| works.values_mut()) {
        if let Some(inner) = counted.as_object_mut() {
            inner.retain(|key, _| !CLOCKS.contains(&key.as_str()));
        }
    }
    if let Some(advice) = entries.get_mut("advice").and_then(Json::as_array_mut) {
        advice.retain(|line| line.as_str().is_some_and(|l| !l.contains(" of the time: ")));
    }
    json
}
