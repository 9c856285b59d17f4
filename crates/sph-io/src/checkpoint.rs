//! Everything a run needs to go on as if it had never stopped.
//!
//! The container is plain enough to be read in ten years by a short script:
//!
//! | bytes | content |
//! |---|---|
//! | 8 | `SPHCKPT` and a zero |
//! | 4 | version of the format, now 1 |
//! | 4 | CRC-32 of the JSON header |
//! | 8 | length of the whole file |
//! | 8 | length of the JSON header |
//! | … | JSON: `meta` as given by the caller, and `columns` with `name`, `type`, `components`, `count` |
//! | … | the columns one after the other, raw |
//! | 4 | CRC-32 of all that stands before |
//!
//! Numbers are little-endian. Reals keep every bit, signed zeros and the
//! payloads of NaNs included. The file is written under a temporary name,
//! synced and renamed; reading it checks all sizes against the length of the
//! file before any memory is reserved, and both checksums before anything is
//! returned.

mod load;
mod save;

use serde::{Deserialize, Serialize};
use serde_json::Value;

const MAGIC: [u8; 8] = *b"SPHCKPT\0";
/// The version written and the only one read.
const VERSION: u32 = 1;
/// Bytes before the JSON header.
const PREFIX: u64 = 32;
/// Longest JSON header, bytes: its content takes many times that in memory.
const HEADER: u64 = 64 << 20;
const COLUMNS: usize = 10_000;
/// Bytes of the checksum at the end.
const SUFFIX: u64 = 4;
/// Bytes converted at a time.
const CHUNK: usize = 1 << 16;

/// A run's state: metadata and columns.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Checkpoint {
    /// Data of the caller, as JSON: scene, time, step, ….
    /// Finite reals come back bit for bit; JSON has no NaN and no infinity.
    pub meta: Value,
    /// Named columns, every name once.
    pub columns: Vec<Column>,
}

/// A named column of numbers.
#[derive(Clone, Debug, PartialEq)]
pub struct Column {
    /// Name, found again by [`Checkpoint::column`].
    pub name: String,
    /// Numbers per tuple, at least 1.
    pub components: usize,
    /// Tuple after tuple.
    pub data: ColumnData,
}

/// The numbers of a [`Column`].
#[derive(Clone, Debug, PartialEq)]
pub enum ColumnData {
    /// Reals.
    F64(Vec<f64>),
    /// Small unsigned integers.
    U32(Vec<u32>),
    /// Large unsigned integers.
    U64(Vec<u64>),
}

impl Checkpoint {
    /// The column called `name`.
    pub fn column(&self, name: &str) -> Option<&Column> {
        self.columns.iter().find(|c| c.name == name)
    }
}

impl ColumnData {
    /// Number of values.
    pub fn len(&self) -> usize {
        match self {
            Self::F64(v) => v.len(),
            Self::U32(v) => v.len(),
            Self::U64(v) => v.len(),
        }
    }

    /// True if there are none.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// All of them as reals.
    pub fn reals(&self) -> Vec<f64> {
        match self {
            Self::F64(v) => v.clone(),
            Self::U32(v) => v.iter().map(|x| f64::from(*x)).collect(),
            Self::U64(v) => v.iter().map(|x| *x as f64).collect(),
        }
    }

    fn kind(&self) -> Kind {
        match self {
            Self::F64(_) => Kind::F64,
            Self::U32(_) => Kind::U32,
            Self::U64(_) => Kind::U64,
        }
    }
}

/// Failed check of a damaged or foreign file.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum CheckpointFault {
    /// The file does not start like a checkpoint.
    #[error("this is not a checkpoint")]
    NotACheckpoint,
    /// The format is of another version, this one.
    #[error("the format has version {0}, only version {known} can be read", known = VERSION)]
    Version(u32),
    /// The file does not have the length it states: that or the least that a checkpoint has, and the length of the file,
    /// bytes.
    #[error("the file has {1} bytes instead of {0}")]
    Length(u64, u64),
    /// The header states sizes that do not add up to the file's length.
    #[error("the sizes in the header do not add up: {0}")]
    Sizes(String),
    /// The header passes its checksum but cannot be understood.
    #[error("the header cannot be understood: {0}")]
    Header(String),
    /// Bytes of the header have changed: the checksum stored, and that of the contents.
    #[error("the header is damaged: its checksum is {1:08x} instead of {0:08x}")]
    HeaderChecksum(u32, u32),
    /// Bytes of the file have changed: the checksum stored, and that of the contents.
    #[error("the data are damaged: the checksum is {1:08x} instead of {0:08x}")]
    Checksum(u32, u32),
}

/// Type of a column in the header.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
enum Kind {
    F64,
    U32,
    U64,
}

/// One column as the header describes it.
#[derive(Debug, Serialize, Deserialize)]
struct Shape {
    name: String,
    #[serde(rename = "type")]
    kind: Kind,
    components: u64,
    /// Tuples.
    count: u64,
}

impl Shape {
    /// Bytes of the column, unless that is beyond counting.
    fn bytes(&self) -> Option<u64> {
        let size = match self.kind {
            Kind::U32 => 4,
            Kind::F64 | Kind::U64 => 8,
        };
        let numbers = self.components.checked_mul(self.count)?;
        numbers.checked_mul(size)
    }
}

#[derive(Debug, Serialize, Deserialize)]
struct Header<M> {
    meta: M,
    columns: Vec<Shape>,
}
