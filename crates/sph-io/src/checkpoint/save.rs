//! Writing a checkpoint.

use std::io::{self, Write};
use std::path::Path;

use flate2::CrcWriter;

use super::{CHUNK, Checkpoint, ColumnData, Header, MAGIC, PREFIX, SUFFIX, Shape, VERSION};
use crate::error::{IoError, Result};
use crate::files::disk::{Durability, write_atomic};

impl Checkpoint {
    /// Writes the checkpoint to `path`, all or nothing, and waits until it is on the disk.
    pub fn save(&self, path: impl AsRef<Path>) -> Result<()> {
        let path = path.as_ref();
        let shapes = self.shapes().map_err(|p| IoError::input(path, p))?;
        let data: u64 = shapes.iter().filter_map(Shape::bytes).sum();
        let (meta, columns) = (&self.meta, shapes);
        let header = serde_json::to_vec(&Header { meta, columns });
        let header = header.map_err(|e| IoError::Json(path.into(), e))?;
        let total = PREFIX + header.len() as u64 + data + SUFFIX;
        let fill = |file: &mut dyn Write| self.fill(file, &header, total);
        write_atomic(path, Durability::Power, fill)
    }

    fn fill(&self, file: &mut dyn Write, header: &[u8], total: u64) -> io::Result<()> {
        let mut out = CrcWriter::new(file);
        out.write_all(&MAGIC)?;
        out.write_all(&VERSION.to_le_bytes())?;
        out.write_all(&crc32fast::hash(header).to_le_bytes())?;
        out.write_all(&total.to_le_bytes())?;
        out.write_all(&(header.len() as u64).to_le_bytes())?;
        out.write_all(header)?;
        for column in &self.columns {
            match &column.data {
                ColumnData::F64(v) => write_numbers(&mut out, v, f64::to_le_bytes)?,
                ColumnData::U32(v) => write_numbers(&mut out, v, u32::to_le_bytes)?,
                ColumnData::U64(v) => write_numbers(&mut out, v, u64::to_le_bytes)?,
            }
        }
        let sum = out.crc().sum();
        out.write_all(&sum.to_le_bytes())
    }

    /// The columns as the header describes them, or the contradiction.
    fn shapes(&self) -> std::result::Result<Vec<Shape>, String> {
        let mut shapes: Vec<Shape> = Vec::with_capacity(self.columns.len());
        for column in &self.columns {
            let (name, components, data) = (&column.name, column.components, &column.data);
            let numbers = data.len();
            if shapes.iter().any(|s| s.name == *name) {
                return Err(format!("two columns are named `{name}`"));
            }
            if components == 0 || !numbers.is_multiple_of(components) {
                return Err(format!(
                    "column `{name}` holds {numbers} numbers, no multiple of {components} components"
                ));
            }
            shapes.push(Shape {
                name: name.clone(),
                kind: data.kind(),
                components: components as u64,
                count: (numbers / components) as u64,
            });
        }
        Ok(shapes)
    }
}

fn write_numbers<T: Copy, const N: usize>(
    out: &mut impl Write,
    values: &[T],
    image: impl Fn(T) -> [u8; N],
) -> io::Result<()> {
    let mut buffer = Vec::with_capacity(CHUNK);
    for chunk in values.chunks(CHUNK / N) {
        buffer.clear();
        buffer.extend(chunk.iter().flat_map(|&value| image(value)));
        out.write_all(&buffer)?;
    }
    Ok(())
}
