//! Errors of files, with their path.

use std::io;
use std::path::{Path, PathBuf};

use crate::checkpoint::CheckpointFault;

/// Result of everything in this crate.
pub type Result<T> = std::result::Result<T, IoError>;

/// A failed read or write: which file, and why.
///
/// The message of an underlying [`io::Error`] is part of the display text, so
/// that one line has all; the error itself stays reachable as `source`.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum IoError {
    /// The folder does not exist and cannot be created.
    #[error("cannot create folder {}: {source}", path.display())]
    CreateFolder {
        /// The folder.
        path: PathBuf,
        /// The reason of the operating system.
        source: io::Error,
    },
    /// The folder is there but nothing can be written into it.
    #[error("cannot write into folder {}: {source}", path.display())]
    NotWritable {
        /// The folder.
        path: PathBuf,
        /// The reason of the operating system.
        source: io::Error,
    },
    /// Another run writes into the folder.
    #[error(
        "{} is in use by {by}, and two runs in one folder would spoil each other: wait for its end, or take \
         another folder",
        path.display()
    )]
    InUse {
        /// The folder.
        path: PathBuf,
        /// The process that holds it, since when.
        by: String,
    },
    /// No room left for the file (disk or quota).
    #[error("disk full while writing {}: {source}", path.display())]
    DiskFull {
        /// The file that was to be written; it keeps its former content.
        path: PathBuf,
        /// The reason of the operating system.
        source: io::Error,
    },
    /// Writing failed for another reason than a full disk.
    #[error("cannot write {}: {source}", path.display())]
    Write {
        /// The file that was to be written.
        path: PathBuf,
        /// The reason of the operating system.
        source: io::Error,
    },
    /// Reading failed.
    #[error("cannot read {}: {source}", path.display())]
    Read {
        /// The file that was to be read.
        path: PathBuf,
        /// The reason of the operating system.
        source: io::Error,
    },
    /// The file is not of the form that is needed.
    #[error("{}: {problem}", path.display())]
    Unfit {
        /// The file.
        path: PathBuf,
        /// The expected form, and that of the file.
        problem: String,
    },
    /// The data handed over do not fit together; nothing was written.
    #[error("cannot write {}: {problem}", path.display())]
    Input {
        /// The file that was to be written.
        path: PathBuf,
        /// The contradiction, naming the field or column.
        problem: String,
    },
    /// A value cannot be expressed as JSON.
    #[error("cannot write {} as JSON: {source}", path.display())]
    Json {
        /// The file that was to be written.
        path: PathBuf,
        /// The reason of the serialiser.
        source: serde_json::Error,
    },
    /// A table does not read as columns of numbers.
    #[error("{}, line {line}: {problem}", path.display())]
    Table {
        /// The file.
        path: PathBuf,
        /// Line number, from 1.
        line: usize,
        /// The fault, naming the column.
        problem: String,
    },
    /// A series on disk ends before the place where it is to be continued.
    #[error(
        "{} holds {found} {what} but is to be continued after {expected}",
        path.display()
    )]
    TooShort {
        /// The file.
        path: PathBuf,
        /// Unit of the count: `bytes` or `output times`.
        what: &'static str,
        /// The length recorded when the run was interrupted.
        expected: u64,
        /// The length found.
        found: u64,
    },
    /// A file that is to be continued is not of the form that this crate writes.
    #[error("cannot continue {}: {problem}", path.display())]
    Malformed {
        /// The file.
        path: PathBuf,
        /// The fault.
        problem: String,
    },
    /// A checkpoint is damaged or not a checkpoint.
    #[error("checkpoint {}: {fault}", path.display())]
    Checkpoint {
        /// The file.
        path: PathBuf,
        /// The failed check.
        fault: CheckpointFault,
    },
}

impl IoError {
    /// A failed write to `path`, by whether the disk is full.
    pub(crate) fn write(path: &Path, source: io::Error) -> Self {
        let path = path.to_path_buf();
        if is_full(&source) {
            Self::DiskFull { path, source }
        } else {
            Self::Write { path, source }
        }
    }

    /// A failed read of `path`.
    pub(crate) fn read(path: &Path, source: io::Error) -> Self {
        Self::Read {
            path: path.to_path_buf(),
            source,
        }
    }

    /// Data for `path` that do not fit together.
    pub(crate) fn input(path: &Path, problem: impl Into<String>) -> Self {
        Self::Input {
            path: path.to_path_buf(),
            problem: problem.into(),
        }
    }

    /// The file or folder concerned.
    pub fn path(&self) -> &Path {
        match self {
            Self::CreateFolder { path, .. }
            | Self::NotWritable { path, .. }
            | Self::InUse { path, .. }
            | Self::DiskFull { path, .. }
            | Self::Write { path, .. }
            | Self::Read { path, .. }
            | Self::Unfit { path, .. }
            | Self::Input { path, .. }
            | Self::Json { path, .. }
            | Self::Table { path, .. }
            | Self::TooShort { path, .. }
            | Self::Malformed { path, .. }
            | Self::Checkpoint { path, .. } => path,
        }
    }
}

/// True if `error` means that the disk, the quota or the limit of `ulimit -f` is exhausted.
pub(crate) fn is_full(error: &io::Error) -> bool {
    use io::ErrorKind::{FileTooLarge, QuotaExceeded, StorageFull, WriteZero};
    matches!(
        error.kind(),
        StorageFull | QuotaExceeded | WriteZero | FileTooLarge
    )
}
