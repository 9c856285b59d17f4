//! Options of a study.

use std::path::PathBuf;

use crate::{Origin, Record, Variant};

/// Options of a study.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub struct Options {
    /// Folder of all its files.
    pub out: PathBuf,
    /// Threads; `None` for all cores.
    pub threads: Option<usize>,
    /// True if finished variants are run again.
    pub fresh: bool,
    /// Machine and program of the variants, for the records.
    pub origin: Origin,
}

impl Options {
    /// On all cores; finished variants stay.
    pub fn new(out: impl Into<PathBuf>, origin: Origin) -> Self {
        Options {
            out: out.into(),
            threads: None,
            fresh: false,
            origin,
        }
    }

    /// Folder of a variant.
    pub fn folder(&self, variant: &Variant) -> PathBuf {
        self.out.join("variants").join(&variant.name)
    }

    /// Earlier results of a variant.
    pub fn known(&self, variant: &Variant) -> Option<Record> {
        let record = Record::load(&self.folder(variant));
        let forgotten = self.fresh && variant.wanted;
        record.filter(|r| !forgotten && r.fingerprint == variant.fingerprint)
    }

    /// Threads in force.
    pub fn threads(&self) -> usize {
        let cores = || std::thread::available_parallelism().map_or(1, usize::from);
        self.threads.unwrap_or_else(cores)
    }
}
