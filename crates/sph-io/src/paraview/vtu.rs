//! ParaView's `.vtu`: an unstructured grid as XML with raw, compressed arrays.
//!
//! Arrays are appended after the XML in little-endian order, cut into blocks of 1 MiB, each compressed by zlib. An
//! array starts with `UInt64` numbers: count of blocks, block size, size of a shorter last block (0 if none), and the
//! compressed size of every block. Reals keep their 64 bits, the simulated time is in the field data as `TimeValue`,
//! and units are attached as VTK's information key `UNITS_LABEL`, so that names stay plain words.

use std::io::Write as _;
use std::path::Path;

use flate2::Compression;
use flate2::write::ZlibEncoder;

use crate::error::{IoError, Result};
use crate::files::clean::escape;
use crate::files::disk::{Durability, write_atomic};
use crate::paraview::frame::{Cells, FieldData, FieldValues, Piece, SECTIONS};

/// Bytes per compressed block.
const BLOCK: usize = 1 << 20;

/// Writes one piece at `time` (s) to `path`, all or nothing.
pub fn write_vtu(path: impl AsRef<Path>, piece: &Piece, time: f64) -> Result<()> {
    let path = path.as_ref();
    piece.check().map_err(|p| IoError::input(path, p))?;
    if !time.is_finite() {
        return Err(IoError::input(path, format!("the time is {time}")));
    }
    let document = Document::from_piece(piece, time).map_err(|e| IoError::write(path, e))?;
    write_atomic(path, Durability::Process, |file| {
        file.write_all(document.xml.as_bytes())?;
        file.write_all(&document.appended)?;
        file.write_all(b"\n  </AppendedData>\n</VTKFile>\n")
    })
}

/// The XML up to the underscore, and the arrays after it.
#[derive(Default)]
struct Document {
    xml: String,
    appended: Vec<u8>,
}

impl Document {
    fn from_piece(piece: &Piece, time: f64) -> std::io::Result<Self> {
        let points = piece.points.len();
        let cells = piece.cells.len(points);
        let mut doc = Self::default();
        doc.line(
            "<?xml version=\"1.0\"?>\n\
             <VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"LittleEndian\" \
             header_type=\"UInt64\" compressor=\"vtkZLibDataCompressor\">\n  \
             <UnstructuredGrid>\n    <FieldData>",
        );
        let tuples = " NumberOfTuples=\"1\"";
        doc.array("TimeValue", "Float64", tuples, "", time.to_le_bytes())?;
        doc.line(&format!(
            "    </FieldData>\n    <Piece NumberOfPoints=\"{points}\" NumberOfCells=\"{cells}\">"
        ));
        for (tag, location) in SECTIONS {
            doc.line(&format!("      <{tag}>"));
            for field in piece.fields.iter().filter(|f| f.location == location) {
                doc.field(field)?;
            }
            doc.line(&format!("      </{tag}>"));
        }
        doc.line("      <Points>");
        let coordinates = bytes(piece.points.as_flattened(), f64::to_le_bytes);
        let three = " NumberOfComponents=\"3\"";
        doc.array("Points", "Float64", three, "m", coordinates)?;
        doc.line("      </Points>");
        doc.cells(&piece.cells, cells)?;
        doc.xml += "    </Piece>\n  </UnstructuredGrid>\n  <AppendedData encoding=\"raw\">\n_";
        Ok(doc)
    }

    fn line(&mut self, text: &str) {
        self.xml.push_str(text);
        self.xml.push('\n');
    }

    fn field(&mut self, field: &FieldData) -> std::io::Result<()> {
        let data = match &field.data {
            FieldValues::F64(v) => bytes(v, f64::to_le_bytes),
            FieldValues::U32(v) => bytes(v, u32::to_le_bytes),
            FieldValues::I64(v) => bytes(v, i64::to_le_bytes),
        };
        let kind = field.data.kind();
        let shape = format!(" NumberOfComponents=\"{}\"", field.components);
        self.array(&field.name, kind, &shape, &field.unit, data)
    }

    fn cells(&mut self, cells: &Cells, count: usize) -> std::io::Result<()> {
        let (kind, each, corners) = cells.corners();
        let joined = match cells {
            Cells::Vertices => (0..count as i64).flat_map(i64::to_le_bytes).collect(),
            _ => bytes(corners, |p| i64::from(p).to_le_bytes()),
        };
        let ends = (1..=count as i64).map(|i| i * each as i64);
        let offsets: Vec<u8> = ends.flat_map(i64::to_le_bytes).collect();
        self.line("      <Cells>");
        self.array("connectivity", "Int64", "", "", joined)?;
        self.array("offsets", "Int64", "", "", offsets)?;
        self.array("types", "UInt8", "", "", vec![kind; count])?;
        self.line("      </Cells>");
        Ok(())
    }

    /// Declares an array in the XML and appends its compressed bytes.
    fn array(
        &mut self,
        name: &str,
        kind: &str,
        shape: &str,
        unit: &str,
        data: impl AsRef<[u8]>,
    ) -> std::io::Result<()> {
        let (name, unit, offset) = (escape(name), escape(unit), self.appended.len());
        let end = match &*unit {
            "" => "/>".to_string(),
            unit => format!(
                ">\n          <InformationKey name=\"UNITS_LABEL\" location=\"vtkDataArray\">\
                 {unit}</InformationKey>\n        </DataArray>"
            ),
        };
        self.line(&format!(
            "        <DataArray type=\"{kind}\" Name=\"{name}\"{shape} \
             format=\"appended\" offset=\"{offset}\"{end}"
        ));
        append_compressed(&mut self.appended, data.as_ref())
    }
}

/// The little-endian image of `values`.
fn bytes<T: Copy, const N: usize>(values: &[T], image: impl Fn(T) -> [u8; N]) -> Vec<u8> {
    values.iter().flat_map(|value| image(*value)).collect()
}

/// Appends `data` in the block layout of `vtkZLibDataCompressor`.
fn append_compressed(out: &mut Vec<u8>, data: &[u8]) -> std::io::Result<()> {
    let blocks = data.len().div_ceil(BLOCK);
    let head = [blocks, BLOCK, data.len() % BLOCK];
    out.extend(head.iter().flat_map(|&n| (n as u64).to_le_bytes()));
    let sizes = out.len();
    out.resize(sizes + 8 * blocks, 0);
    for (i, block) in data.chunks(BLOCK).enumerate() {
        let start = out.len();
        let mut encoder = ZlibEncoder::new(&mut *out, Compression::fast());
        encoder.write_all(block)?;
        encoder.finish()?;
        let size = (out.len() - start) as u64;
        out[sizes + 8 * i..][..8].copy_from_slice(&size.to_le_bytes());
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::paraview::vtu_read::expanded;

    #[test]
    fn blocks_expand_to_what_went_in() {
        for size in [0, 1, BLOCK - 1, BLOCK, BLOCK + 1, 2 * BLOCK, 2 * BLOCK + 77] {
            let data: Vec<u8> = (0..size).map(|i| (i * i % 251) as u8).collect();
            let mut out = Vec::new();
            append_compressed(&mut out, &data).unwrap();
            assert!(expanded(&out).unwrap() == data, "{size} bytes");
            let (words, _) = out.as_chunks().0.split_at(3 + size.div_ceil(BLOCK));
            let word = |w: &[u8; 8]| u64::from_le_bytes(*w) as usize;
            let words: Vec<usize> = words.iter().map(word).collect();
            assert_eq!(words[..3], [words.len() - 3, BLOCK, size % BLOCK]);
            let blocks: usize = words[3..].iter().sum();
            assert_eq!(out.len(), 8 * words.len() + blocks);
        }
    }

    #[test]
    fn an_infinite_time_is_refused() {
        let folder = tempfile::tempdir().unwrap();
        let piece = Piece {
            name: "fluid".into(),
            points: vec![].into(),
            cells: Cells::Vertices,
            fields: vec![],
        };
        let path = folder.path().join("a.vtu");
        assert!(write_vtu(&path, &piece, f64::NAN).is_err());
        assert!(!path.exists());
        write_vtu(&path, &piece, 0.0).unwrap();
    }
}
