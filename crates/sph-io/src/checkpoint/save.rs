//! Writing a checkpoint.

use std::io::{self, Write};
use std::path::Path;

use super::{Checkpoint, Column, ColumnData, Header, MAGIC, PREFIX, SUFFIX, Shape, VERSION};
use crate::error::{IoError, Result};
use crate::files::atomic::{Durability, write_atomic};

/// Bytes converted at a time.
const CHUNK: usize = 1 << 16;

impl Checkpoint {
    /// Writes the checkpoint to `path`, all or nothing, and waits until it is
    /// on the disk.
    pub fn save(&self, path: impl AsRef<Path>) -> Result<()> {
        let path = path.as_ref();
        let shapes = self.shapes().map_err(|p| IoError::input(path, p))?;
        let data: u64 = shapes.iter().filter_map(Shape::bytes).sum();
        let header = Header {
            meta: &self.meta,
            columns: shapes,
        };
        let header = serde_json::to_vec(&header).map_err(|source| IoError::Json {
            path: path.to_path_buf(),
            source,
        })?;
        let total = PREFIX + header.len() as u64 + data + SUFFIX;
        write_atomic(path, Durability::Power, |file| {
            self.fill(file, &header, total)
        })
    }

    fn fill(&self, file: &mut dyn Write, header: &[u8], total: u64) -> io::Result<()> {
        let mut out = ChecksumWriter {
            out: file,
            sum: crc32fast::Hasher::new(),
        };
        out.put(&MAGIC)?;
        out.put(&VERSION.to_le_bytes())?;
        out.put(&crc32fast::hash(header).to_le_bytes())?;
        out.put(&total.to_le_bytes())?;
        out.put(&(header.len() as u64).to_le_bytes())?;
        out.put(header)?;
        for column in &self.columns {
            match &column.data {
                ColumnData::F64(v) => out.numbers(v, f64::to_le_bytes)?,
                ColumnData::U32(v) => out.numbers(v, u32::to_le_bytes)?,
                ColumnData::U64(v) => out.numbers(v, u64::to_le_bytes)?,
            }
        }
        let sum = out.sum.clone().finalize();
        out.put(&sum.to_le_bytes())
    }

    /// The columns as the header describes them, or the contradiction.
    fn shapes(&self) -> std::result::Result<Vec<Shape>, String> {
        let mut shapes: Vec<Shape> = Vec::with_capacity(self.columns.len());
        for column in &self.columns {
            if shapes.iter().any(|s| s.name == column.name) {
                return Err(format!("two columns are named `{}`", column.name));
            }
            shapes.push(column.shape()?);
        }
        Ok(shapes)
    }
}

impl Column {
    fn shape(&self) -> std::result::Result<Shape, String> {
        let (numbers, components) = (self.data.len(), self.components);
        if components == 0 || !numbers.is_multiple_of(components) {
            let name = &self.name;
            return Err(format!(
                "column `{name}` holds {numbers} numbers, no multiple of {components} components"
            ));
        }
        Ok(Shape {
            name: self.name.clone(),
            kind: self.data.kind(),
            components: components as u64,
            count: (numbers / components) as u64,
        })
    }
}

/// Passes bytes on and keeps their checksum.
struct ChecksumWriter<'a> {
    out: &'a mut dyn Write,
    sum: crc32fast::Hasher,
}

impl ChecksumWriter<'_> {
    fn put(&mut self, bytes: &[u8]) -> io::Result<()> {
        self.sum.update(bytes);
        self.out.write_all(bytes)
    }

    fn numbers<T: Copy, const N: usize>(
        &mut self,
        values: &[T],
        image: impl Fn(T) -> [u8; N],
    ) -> io::Result<()> {
        let mut buffer = Vec::with_capacity(CHUNK);
        for chunk in values.chunks(CHUNK / N) {
            buffer.clear();
            for &value in chunk {
                buffer.extend_from_slice(&image(value));
            }
            self.put(&buffer)?;
        }
        Ok(())
    }
}
