//! Errors of files, with their path.

use std::io;
use std::path::{Path, PathBuf};

use crate::checkpoint::CheckpointFault;

/// Result of everything in this crate.
pub type Result<T> = std::result::Result<T, IoError>;

/// A failed read or write: the file or folder concerned, and the reason.
///
/// The message of an underlying [`io::Error`] is part of the display text, so
/// that one line has all; the error itself stays reachable as `source`.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum IoError {
    /// The folder does not exist and cannot be created.
    #[error("cannot create folder {}: {}", .0.display(), .1)]
    CreateFolder(PathBuf, #[source] io::Error),
    /// The folder is there but nothing can be written into it.
    #[error("cannot write into folder {}: {}", .0.display(), .1)]
    NotWritable(PathBuf, #[source] io::Error),
    /// Another run writes into the folder: its process, since when.
    #[error(
        "{} is in use by {}, and two runs in one folder would spoil each other: wait for its end, or take \
         another folder",
        .0.display(),
        .1
    )]
    InUse(PathBuf, String),
    /// No room left for the file (disk or quota), which keeps its former content.
    #[error("disk full while writing {}: {}", .0.display(), .1)]
    DiskFull(PathBuf, #[source] io::Error),
    /// Writing failed for another reason than a full disk.
    #[error("cannot write {}: {}", .0.display(), .1)]
    Write(PathBuf, #[source] io::Error),
    /// Reading failed.
    #[error("cannot read {}: {}", .0.display(), .1)]
    Read(PathBuf, #[source] io::Error),
    /// The file is not of the form that is needed: the expected form, and that of the file.
    #[error("{}: {}", .0.display(), .1)]
    Unfit(PathBuf, String),
    /// The data for the file do not fit together, and nothing was written: the contradiction, naming the field or
    /// column.
    #[error("cannot write {}: {}", .0.display(), .1)]
    Input(PathBuf, String),
    /// A value cannot be expressed as JSON.
    #[error("cannot write {} as JSON: {}", .0.display(), .1)]
    Json(PathBuf, #[source] serde_json::Error),
    /// A table does not read as columns of numbers: the line, from 1, and the fault, naming the column.
    #[error("{}, line {}: {}", .0.display(), .1, .2)]
    Table(PathBuf, usize, String),
    /// A series on disk ends before the place where it is to be continued: its length, in `bytes` or `output times`, and
    /// the length that the checkpoint has.
    #[error("{} holds {} {} but is to be continued after {}", .0.display(), .1, .2, .3)]
    TooShort(PathBuf, u64, &'static str, u64),
    /// A file that is to be continued is not of the form that this crate writes.
    #[error("cannot continue {}: {}", .0.display(), .1)]
    Malformed(PathBuf, String),
    /// A checkpoint is damaged or not a checkpoint: the failed check.
    #[error("checkpoint {}: {}", .0.display(), .1)]
    Checkpoint(PathBuf, CheckpointFault),
}

impl IoError {
    /// A failed write to `path`, by whether the disk is full.
    pub(crate) fn write(path: &Path, source: io::Error) -> Self {
        match is_full(&source) {
            true => Self::DiskFull(path.into(), source),
            false => Self::Write(path.into(), source),
        }
    }

    pub(crate) fn read(path: &Path, source: io::Error) -> Self {
        Self::Read(path.into(), source)
    }

    /// Data for `path` that do not fit together.
    pub(crate) fn input(path: &Path, problem: impl Into<String>) -> Self {
        Self::Input(path.into(), problem.into())
    }
}

/// True if `error` means that the disk, the quota or the limit of `ulimit -f` is exhausted.
pub(crate) fn is_full(error: &io::Error) -> bool {
    use io::ErrorKind::{FileTooLarge, QuotaExceeded, StorageFull, WriteZero};
    let full = [StorageFull, QuotaExceeded, WriteZero, FileTooLarge];
    full.contains(&error.kind())
}
