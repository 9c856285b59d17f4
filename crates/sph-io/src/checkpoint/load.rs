//! Reading a checkpoint, trusting nothing.

use std::fs::File;
use std::io::{self, BufReader, Read};
use std::path::Path;

use flate2::CrcReader;
use serde_json::Value;

use super::{
    CHUNK, COLUMNS, Checkpoint, CheckpointFault as Fault, Column, ColumnData, HEADER, Header, Kind,
    MAGIC, PREFIX, SUFFIX, Shape, VERSION,
};
use crate::error::{IoError, Result};
use crate::files::disk::readable;

impl Checkpoint {
    /// Reads the checkpoint at `path`; any damage is an error that names the check failed.
    pub fn load(path: impl AsRef<Path>) -> Result<Self> {
        let path = path.as_ref();
        let failed = |e| IoError::read(path, e);
        // Opening a pipe would wait for its writer.
        readable(path, u64::MAX)?;
        let file = File::open(path).map_err(failed)?;
        let length = file.metadata().map_err(failed)?.len();
        let input = CrcReader::new(BufReader::with_capacity(CHUNK, file));
        let read = Source { input, length }.checkpoint();
        read.map_err(|trouble| match trouble {
            ReadFault::Read(source) => IoError::read(path, source),
            ReadFault::Fault(fault) => IoError::Checkpoint(path.into(), fault),
        })
    }

    /// Reads a checkpoint that is in memory.
    ///
    /// # Errors
    /// The check that failed.
    pub fn from_bytes(bytes: &[u8]) -> std::result::Result<Self, Fault> {
        let length = bytes.len() as u64;
        let input = CrcReader::new(bytes);
        let read = Source { input, length }.checkpoint();
        read.map_err(|trouble| match trouble {
            ReadFault::Fault(fault) => fault,
            // Sizes are checked first, so that there is always enough to read.
            ReadFault::Read(_) => Fault::Length(PREFIX + SUFFIX, length),
        })
    }
}

/// Reason that a checkpoint could not be read: the disk, or its contents.
#[derive(Debug, thiserror::Error)]
#[error(transparent)]
enum ReadFault {
    Read(#[from] io::Error),
    Fault(#[from] Fault),
}

/// The file, and the checksum of the part that has been read.
struct Source<R> {
    input: CrcReader<R>,
    length: u64,
}

impl<R: Read> Source<R> {
    fn checkpoint(mut self) -> std::result::Result<Checkpoint, ReadFault> {
        let Header { meta, columns } = self.header()?;
        let columns = columns.into_iter().map(|shape| self.column(shape));
        let columns = columns.collect::<std::result::Result<_, ReadFault>>()?;
        let found = self.input.crc().sum();
        let expected = u32::from_le_bytes(self.take()?);
        if found != expected {
            return Err(Fault::Checksum(expected, found).into());
        }
        Ok(Checkpoint { meta, columns })
    }

    /// Everything before the columns; on return their sizes are known to fit.
    fn header(&mut self) -> std::result::Result<Header<Value>, ReadFault> {
        let found = self.length;
        let least = PREFIX + SUFFIX;
        if found < MAGIC.len() as u64 || self.take()? != MAGIC {
            return Err(Fault::NotACheckpoint.into());
        }
        if found < least {
            return Err(Fault::Length(least, found).into());
        }
        let version = u32::from_le_bytes(self.take()?);
        if version != VERSION {
            return Err(Fault::Version(version).into());
        }
        let sum = u32::from_le_bytes(self.take()?);
        let stated = u64::from_le_bytes(self.take()?);
        if stated != found {
            return Err(Fault::Length(stated, found).into());
        }
        let size = u64::from_le_bytes(self.take()?);
        let room = found - least;
        let refused = |said: String| Err(Fault::Sizes(said).into());
        if size > room {
            return refused(format!("a header of {size} bytes where {room} are left"));
        }
        if size > HEADER {
            return refused(format!("a header of {size} bytes, more than {HEADER}"));
        }
        let text = self.bytes(size)?;
        let actual = crc32fast::hash(&text);
        if actual != sum {
            return Err(Fault::HeaderChecksum(sum, actual).into());
        }
        let header: Header<Value> =
            serde_json::from_slice(&text).map_err(|e| Fault::Header(e.to_string()))?;
        fits(&header.columns, room - size)?;
        Ok(header)
    }

    fn column(&mut self, shape: Shape) -> std::result::Result<Column, ReadFault> {
        let bytes = shape.bytes().unwrap_or(0);
        let data = match shape.kind {
            Kind::F64 => ColumnData::F64(self.numbers(bytes, f64::from_le_bytes)?),
            Kind::U32 => ColumnData::U32(self.numbers(bytes, u32::from_le_bytes)?),
            Kind::U64 => ColumnData::U64(self.numbers(bytes, u64::from_le_bytes)?),
        };
        let components = usize::try_from(shape.components)
            .map_err(|_| Fault::Sizes(format!("column `{}` is too wide", shape.name)))?;
        Ok(Column {
            name: shape.name,
            components,
            data,
        })
    }

    /// The next `bytes` bytes as numbers of `N` bytes each.
    fn numbers<T, const N: usize>(
        &mut self,
        bytes: u64,
        number: impl Fn([u8; N]) -> T,
    ) -> io::Result<Vec<T>> {
        let mut left = bytes;
        let mut values = Vec::with_capacity((bytes / N as u64) as usize);
        while left > 0 {
            let part = self.bytes(left.min(CHUNK as u64))?;
            let (images, _) = part.as_chunks::<N>();
            values.extend(images.iter().map(|&image| number(image)));
            left -= part.len() as u64;
        }
        Ok(values)
    }

    fn bytes(&mut self, count: u64) -> io::Result<Vec<u8>> {
        let mut bytes = vec![0; count as usize];
        self.input.read_exact(&mut bytes)?;
        Ok(bytes)
    }

    fn take<const N: usize>(&mut self) -> io::Result<[u8; N]> {
        let mut bytes = [0; N];
        self.input.read_exact(&mut bytes)?;
        Ok(bytes)
    }
}

/// True if the columns take up exactly `room` bytes and are well formed.
fn fits(columns: &[Shape], room: u64) -> std::result::Result<(), Fault> {
    let count = columns.len();
    let refused = |said: String| Err(Fault::Sizes(said));
    if count > COLUMNS {
        return refused(format!("{count} columns, more than {COLUMNS}"));
    }
    let mut total: u64 = 0;
    for (i, shape) in columns.iter().enumerate() {
        let name = &shape.name;
        if shape.components == 0 {
            return refused(format!("column `{name}` has no components"));
        }
        if columns[..i].iter().any(|s| s.name == *name) {
            return Err(Fault::Header(format!("two columns are named `{name}`")));
        }
        match shape.bytes().and_then(|bytes| bytes.checked_add(total)) {
            Some(sum) if sum <= room => total = sum,
            _ => return refused(format!("column `{name}` reaches beyond the end")),
        }
    }
    match total < room {
        true => refused(format!("the columns take {total} of {room} bytes")),
        false => Ok(()),
    }
}
