//! The state in which a run ended, to be compared bit for bit.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use sph_io::{Checkpoint, ColumnData};

/// Everything of a results folder that a resumed run must reproduce.
#[derive(Debug, PartialEq)]
pub struct FinalState {
    /// Bits of the simulated time and the step.
    pub clock: [u64; 2],
    /// Columns of the checkpoint, reals as bits.
    pub columns: BTreeMap<String, Vec<u64>>,
    /// The time series.
    pub series: String,
    /// Every file of fields, by name.
    pub fields: BTreeMap<PathBuf, Vec<u8>>,
}

impl FinalState {
    /// Reads a results folder.
    pub fn of(folder: &Path) -> Self {
        let checkpoint = Checkpoint::load(folder.join("checkpoint.sph")).expect("a checkpoint");
        let clock = &checkpoint.meta["clock"];
        let bits = |name: &str| clock[name].as_u64().expect("a clock");
        let columns = checkpoint.columns.iter().map(|column| {
            let bits = match &column.data {
                ColumnData::F64(v) => v.iter().map(|x| x.to_bits()).collect(),
                ColumnData::U32(v) => v.iter().map(|x| u64::from(*x)).collect(),
                ColumnData::U64(v) => v.clone(),
            };
            (column.name.clone(), bits)
        });
        let frames = files_with_extension(folder, "vtu").into_iter().map(|path| {
            let name = path
                .strip_prefix(folder)
                .expect("below the folder")
                .to_path_buf();
            (name, std::fs::read(path).expect("a file of fields"))
        });
        FinalState {
            clock: [bits("time"), bits("dt")],
            columns: columns.collect(),
            series: std::fs::read_to_string(folder.join("series.csv")).expect("a series"),
            fields: frames.collect(),
        }
    }

    /// Fails with the name of what differs.
    pub fn assert_same(&self, other: &Self, what: &str) {
        let names = |s: &Self| s.columns.keys().cloned().collect::<Vec<_>>();
        assert_eq!(names(self), names(other), "{what}: columns");
        for (name, column) in &self.columns {
            let there = &other.columns[name];
            let differ = column.iter().zip(there).filter(|(a, b)| a != b).count();
            assert_eq!(column.len(), there.len(), "{what}: length of {name}");
            assert_eq!(
                differ,
                0,
                "{what}: {differ} of {} numbers of {name}",
                column.len()
            );
        }
        assert_eq!(self.clock, other.clock, "{what}: clock");
        let lines = self.series.lines().zip(other.series.lines());
        for (k, (a, b)) in lines.enumerate() {
            assert_eq!(a, b, "{what}: line {} of series.csv", k + 1);
        }
        assert_eq!(
            self.series.len(),
            other.series.len(),
            "{what}: length of series.csv"
        );
        let names = |s: &Self| s.fields.keys().cloned().collect::<Vec<_>>();
        assert_eq!(names(self), names(other), "{what}: files of fields");
        for (name, bytes) in &self.fields {
            assert!(
                *bytes == other.fields[name],
                "{what}: {} differs",
                name.display()
            );
        }
    }
}

/// All files below a folder with an extension, sorted.
pub fn files_with_extension(folder: &Path, extension: &str) -> Vec<PathBuf> {
    let mut found = Vec::new();
    let mut open = vec![folder.to_path_buf()];
    while let Some(folder) = open.pop() {
        for entry in std::fs::read_dir(folder).into_iter().flatten().flatten() {
            let path = entry.path();
            if path.is_dir() {
                open.push(path);
            } else if path.extension().is_some_and(|e| e == extension) {
                found.push(path);
            }
        }
    }
    found.sort();
    found
}
