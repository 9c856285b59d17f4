//! Reads back files of [`write_vtu`](crate::write_vtu); it is no reader of all of VTK.

use std::fs;
use std::io::Read as _;
use std::path::Path;

use flate2::read::ZlibDecoder;
use roxmltree::{Document, Node};

use crate::error::{IoError, Result};
use crate::paraview::frame::{Cells, FieldData, FieldValues, Location, Piece, SECTIONS};

/// A part of a file, or what is wrong with it.
type Parsed<T> = std::result::Result<T, &'static str>;

/// Largest array that is read, bytes.
const MOST: usize = 1 << 36;

/// Reads a piece and its time (s); its name is that of the file without its number.
///
/// # Errors
/// A file that cannot be read, or that is not one of [`write_vtu`](crate::write_vtu).
pub fn read_vtu(path: impl AsRef<Path>) -> Result<(Piece<'static>, f64)> {
    let path = path.as_ref();
    let bytes = fs::read(path).map_err(|e| IoError::read(path, e))?;
    let unfit = |problem: &str| {
        let problem = format!("it is not a VTU file of this program: {problem}");
        IoError::Unfit(path.into(), problem)
    };
    piece(&bytes, piece_name(path)).map_err(unfit)
}

/// The name of a file without its number.
pub(crate) fn piece_name(path: &Path) -> String {
    let stem = path.file_stem().unwrap_or_default().to_string_lossy();
    let name = stem.rsplit_once('_').map_or(&*stem, |(name, _)| name);
    name.to_string()
}

/// An array as the XML declares it, with the bytes that belong to it.
struct Array {
    name: String,
    kind: String,
    components: usize,
    unit: String,
    bytes: Vec<u8>,
}

fn piece(file: &[u8], name: String) -> Parsed<(Piece<'static>, f64)> {
    const MARK: &[u8] = b"<AppendedData encoding=\"raw\">\n_";
    let end = file.windows(MARK.len()).position(|w| w == MARK);
    let end = end.ok_or("its arrays are not appended")?;
    let head = std::str::from_utf8(&file[..end]).map_err(|_| "its head is no text")?;
    let head = format!("{head}</VTKFile>");
    let head = Document::parse(&head).map_err(|_| "a tag cannot be read")?;
    let appended = &file[end + MARK.len()..];
    let section = |tag: &str| -> Parsed<Vec<Array>> {
        let section = head.descendants().find(|n| n.has_tag_name(tag));
        let arrays = section.ok_or("a section is missing")?.children();
        let arrays = arrays.filter(|n| n.has_tag_name("DataArray"));
        arrays.map(|node| array(node, appended)).collect()
    };
    let time = section("FieldData")?.pop().ok_or("it has no time")?;
    let time = numbers(&time.bytes, f64::from_le_bytes);
    let time = *time.first().ok_or("it has no time")?;
    let points = section("Points")?.pop().ok_or("it has no points")?;
    let points = numbers(&points.bytes, f64::from_le_bytes);
    let (points, _) = points.as_chunks::<3>();
    let mut fields = Vec::new();
    for (tag, location) in SECTIONS {
        for array in section(tag)? {
            fields.push(field(array, location)?);
        }
    }
    let piece = Piece {
        name: name.into(),
        points: points.to_vec().into(),
        cells: cells(&section("Cells")?)?,
        fields,
    };
    let fits = piece.check().map_err(|_| "its arrays do not fit together");
    fits.map(|()| (piece, time))
}

fn array(node: Node<'_, '_>, appended: &[u8]) -> Parsed<Array> {
    let get = |name| node.attribute(name);
    let offset = get("offset").and_then(|o| o.parse::<usize>().ok());
    let data = offset.and_then(|o| appended.get(o..));
    let mut keys = node.children();
    let unit = keys.find(|n| n.has_tag_name("InformationKey"));
    Ok(Array {
        name: get("Name").ok_or("an array has no name")?.into(),
        kind: get("type").ok_or("an array has no type")?.into(),
        components: get("NumberOfComponents")
            .map_or(Ok(1), |n| n.parse().map_err(|_| "a number"))?,
        unit: unit.and_then(|n| n.text()).unwrap_or_default().into(),
        bytes: expanded(data.ok_or("an array lies outside of the file")?)?,
    })
}

/// The blocks of `vtkZLibDataCompressor`, expanded.
pub(crate) fn expanded(data: &[u8]) -> Parsed<Vec<u8>> {
    let cut = "an array is cut off";
    let word = |k: usize| {
        let bytes = data.get(8 * k..8 * k + 8)?;
        usize::try_from(u64::from_le_bytes(bytes.try_into().ok()?)).ok()
    };
    let head = |k: usize| word(k).ok_or(cut);
    let (blocks, block, last) = (head(0)?, head(1)?, head(2)?);
    if blocks > data.len() / 8 || block.saturating_mul(blocks) > MOST || last > block {
        return Err("an array is too large");
    }
    let mut out = Vec::new();
    let mut at = 8 * (3 + blocks);
    for k in 0..blocks {
        let end = at.checked_add(head(3 + k)?).ok_or(cut)?;
        let whole = k + 1 < blocks || last == 0;
        let length = if whole { block } else { last };
        let before = out.len();
        let decoder = ZlibDecoder::new(data.get(at..end).ok_or(cut)?);
        let read = decoder.take(length as u64 + 1).read_to_end(&mut out);
        if read.is_err() || out.len() != before + length {
            return Err("an array does not expand to its length");
        }
        at = end;
    }
    Ok(out)
}

fn field(array: Array, location: Location) -> Parsed<FieldData<'static>> {
    let data = match array.kind.as_str() {
        "Float64" => FieldValues::F64(numbers(&array.bytes, f64::from_le_bytes).into()),
        "UInt32" => FieldValues::U32(numbers(&array.bytes, u32::from_le_bytes).into()),
        "Int64" => FieldValues::I64(numbers(&array.bytes, i64::from_le_bytes).into()),
        _ => return Err("an array has a type of other programs"),
    };
    Ok(FieldData {
        name: array.name.into(),
        unit: array.unit.into(),
        location,
        components: array.components,
        data,
    })
}

fn numbers<T, const N: usize>(bytes: &[u8], number: fn([u8; N]) -> T) -> Vec<T> {
    let (images, _) = bytes.as_chunks::<N>();
    images.iter().map(|image| number(*image)).collect()
}

fn cells(arrays: &[Array]) -> Parsed<Cells<'static>> {
    let get = |name| arrays.iter().find(|a| a.name == name);
    let (Some(joined), Some(types)) = (get("connectivity"), get("types")) else {
        return Err("it has no cells");
    };
    let joined = numbers(&joined.bytes, |image| i64::from_le_bytes(image) as u32);
    Ok(match types.bytes.first() {
        None | Some(1) => Cells::Vertices,
        Some(3) => Cells::Segments(joined.as_chunks::<2>().0.to_vec().into()),
        Some(5) => Cells::Triangles(joined.as_chunks::<3>().0.to_vec().into()),
        Some(10) => Cells::Tetrahedra(joined.as_chunks::<4>().0.to_vec().into()),
        _ => return Err("it has cells of other programs"),
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::write_vtu;

    fn sample() -> Piece<'static> {
        let count = 200_000;
        let points: Vec<[f64; 3]> = (0..count).map(|i| [i as f64, 0.5, -1e-300]).collect();
        let pressure: Vec<f64> = (0..count).map(|i| (i as f64).sin()).collect();
        let number: Vec<u32> = (0..count).collect();
        let segments: Vec<[u32; 2]> = (1..count).map(|i| [i - 1, i]).collect();
        let normal = vec![1.0; 3 * segments.len()];
        let fields = vec![
            FieldData::scalar("pressure", "Pa", pressure),
            FieldData::integer("identity", number),
            FieldData::tensor("normal", "m/s² & <more>", 3, normal).at_cells(),
        ];
        Piece {
            name: "two_words".into(),
            points: points.into(),
            cells: Cells::Segments(segments.into()),
            fields,
        }
    }

    #[test]
    fn written_frames_are_read_to_the_last_bit() {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("two_words_000003.vtu");
        let piece = sample();
        write_vtu(&path, &piece, 0.1 + 0.2).expect("written");
        let (read, time) = read_vtu(&path).expect("read");
        assert_eq!(time.to_bits(), (0.1_f64 + 0.2).to_bits());
        assert_eq!(format!("{read:?}"), format!("{piece:?}"));
    }

    #[test]
    fn truncated_and_garbled_files_are_refused() {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("a_0.vtu");
        let piece = Piece {
            fields: vec![],
            ..sample()
        };
        write_vtu(&path, &piece, 0.0).expect("written");
        let whole = fs::read(&path).expect("read");
        for length in [0, 10, 700, whole.len() / 2] {
            fs::write(&path, &whole[..length]).expect("cut");
            let told = read_vtu(&path).unwrap_err().to_string();
            assert!(told.contains("not a VTU file of this program"), "{told}");
        }
        let mut bad = whole.clone();
        let middle = bad.len() / 2;
        bad[middle] ^= 0x55;
        fs::write(&path, &bad).expect("garbled");
        assert!(read_vtu(&path).is_err());
    }
}
