//! ParaView's `.pvtu`: a piece whose points several processes wrote, each into a `.vtu` of its own.
//!
//! It has no numbers: it names the arrays that all files have, and the files, which lie beside it.

use std::borrow::Cow;
use std::fs;
use std::path::{Path, PathBuf};

use roxmltree::Document;

use crate::error::{IoError, Result};
use crate::files::clean::escape;
use crate::files::disk::{beside, write_whole};
use crate::paraview::frame::{Cells, FieldData, FieldValues, Piece, SECTIONS};
use crate::paraview::vtu::write_vtu;
use crate::paraview::vtu_read::{piece_name, read_vtu};

/// Writes a process's share of a piece of frame `index` at `time` (s) into a folder, `fluid_000003_r1.vtu` for rank 1, and
/// returns its path.
///
/// # Errors
/// A file that cannot be written; a piece whose parts do not fit together.
pub fn write_share(
    folder: impl AsRef<Path>,
    piece: &Piece,
    (index, rank): (usize, usize),
    time: f64,
) -> Result<PathBuf> {
    let path = folder.as_ref().join(share_name(piece, index, rank));
    write_vtu(&path, piece, time)?;
    Ok(path)
}

/// `name` with everything but letters, digits, `-` and `_` replaced.
pub(crate) fn file_name(name: &str) -> String {
    let odd = |c: char| !(c.is_ascii_alphanumeric() || c == '-' || c == '_');
    match name {
        "" => "piece".into(),
        name => name.replace(odd, "_"),
    }
}

fn share_name(piece: &Piece, index: usize, rank: usize) -> String {
    format!("{}_{index:06}_r{rank}.vtu", file_name(&piece.name))
}

/// Writes the list of the shares of a piece of points; `piece` has the arrays that all shares have, with any contents.
pub(crate) fn write_pvtu(path: &Path, piece: &Piece, index: usize, ranks: usize) -> Result<()> {
    let mut xml = String::from(
        "<?xml version=\"1.0\"?>\n<VTKFile type=\"PUnstructuredGrid\" version=\"1.0\" byte_order=\"LittleEndian\" \
         header_type=\"UInt64\">\n  <PUnstructuredGrid GhostLevel=\"0\">\n",
    );
    for (tag, location) in SECTIONS {
        xml.push_str(&format!("    <P{tag}>\n"));
        for field in piece.fields.iter().filter(|f| f.location == location) {
            let (kind, name) = (field.data.kind(), escape(&field.name));
            xml.push_str(&format!(
                "      <PDataArray type=\"{kind}\" Name=\"{name}\" NumberOfComponents=\"{}\"/>\n",
                field.components
            ));
        }
        xml.push_str(&format!("    </P{tag}>\n"));
    }
    xml += "    <PPoints>\n      <PDataArray type=\"Float64\" Name=\"Points\" NumberOfComponents=\"3\"/>\n    \
            </PPoints>\n";
    for rank in 0..ranks {
        let file = share_name(piece, index, rank);
        xml.push_str(&format!("    <Piece Source=\"{file}\"/>\n"));
    }
    xml.push_str("  </PUnstructuredGrid>\n</VTKFile>\n");
    write_whole(path, xml)
}

/// Reads a piece that one process wrote, or several, and its time (s); its name is that of the file without its number.
///
/// # Errors
/// A file that cannot be read, or that is not one of this crate.
pub fn read_piece(path: impl AsRef<Path>) -> Result<(Piece<'static>, f64)> {
    let path = path.as_ref();
    if path.extension().is_none_or(|e| e != "pvtu") {
        return read_vtu(path);
    }
    let unfit = |problem: &str| {
        let problem = format!("it is not a PVTU file of this program: {problem}");
        IoError::Unfit(path.into(), problem)
    };
    let text = fs::read_to_string(path).map_err(|e| IoError::read(path, e))?;
    let mut whole: Option<(Piece<'static>, f64)> = None;
    let document = Document::parse(&text).map_err(|_| unfit("a tag cannot be read"))?;
    for piece in document.descendants().filter(|n| n.has_tag_name("Piece")) {
        let source = piece.attribute("Source");
        let source = source.ok_or_else(|| unfit("a piece has no file"))?;
        let (mut share, time) = read_vtu(beside(path, source.as_ref())?)?;
        whole = Some(match whole {
            None => {
                share.name = piece_name(path).into();
                (share, time)
            }
            Some((all, at)) if at == time => {
                let all = joined(all, share).ok_or_else(|| unfit("its files differ"))?;
                (all, at)
            }
            Some(_) => return Err(unfit("its files are of several times")),
        });
    }
    whole.ok_or_else(|| unfit("it names no file"))
}

/// Two shares of points one after the other; nothing if they have other fields, or cells that are more than points.
fn joined(mut all: Piece<'static>, more: Piece<'static>) -> Option<Piece<'static>> {
    let points = |piece: &Piece| matches!(piece.cells, Cells::Vertices);
    if !points(&all) || !points(&more) || all.fields.len() != more.fields.len() {
        return None;
    }
    all.points.to_mut().extend_from_slice(&more.points);
    let fields = all.fields.into_iter().zip(more.fields);
    all.fields = fields.map(same_fields).collect::<Option<_>>()?;
    Some(all)
}

fn same_fields((a, b): (FieldData<'static>, FieldData<'static>)) -> Option<FieldData<'static>> {
    if a.name != b.name || a.components != b.components || a.location != b.location {
        return None;
    }
    let data = match (a.data, b.data) {
        (FieldValues::F64(v), FieldValues::F64(w)) => FieldValues::F64(extended(v, &w)),
        (FieldValues::U32(v), FieldValues::U32(w)) => FieldValues::U32(extended(v, &w)),
        (FieldValues::I64(v), FieldValues::I64(w)) => FieldValues::I64(extended(v, &w)),
        _ => return None,
    };
    Some(FieldData { data, ..a })
}

fn extended<'a, T: Clone>(mut values: Cow<'a, [T]>, more: &[T]) -> Cow<'a, [T]> {
    values.to_mut().extend_from_slice(more);
    values
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::PvdSeries;
    use crate::paraview::frame::Frame;

    fn share(first: u32, count: u32) -> Piece<'static> {
        let numbers = first..first + count;
        let points: Vec<[f64; 3]> = numbers.clone().map(|k| [f64::from(k), 0.5, 0.0]).collect();
        let pressure: Vec<f64> = numbers.clone().map(|k| f64::from(k) * 10.0).collect();
        Piece {
            name: "fluid".into(),
            points: points.into(),
            cells: Cells::Vertices,
            fields: vec![
                FieldData::integer("identity", numbers.collect::<Vec<u32>>()),
                FieldData::scalar("pressure", "Pa", pressure),
            ],
        }
    }

    #[test]
    fn files_of_two_ranks_are_read_as_one_piece() {
        let folder = tempfile::tempdir().unwrap();
        let mut series = PvdSeries::create(folder.path().join("fields.pvd")).unwrap();
        let below = folder.path().join("fields");
        write_share(&below, &share(3, 2), (0, 1), 0.25).unwrap();
        let frame = Frame {
            time: 0.25,
            index: 0,
            pieces: vec![share(0, 3)],
        };
        let written = series.write(&frame, 2).unwrap();
        assert!(written[0].ends_with("fields/fluid_000000.pvtu"));
        let (piece, time) = read_piece(&written[0]).unwrap();
        assert_eq!((time, &*piece.name, piece.points.len()), (0.25, "fluid", 5));
        let FieldValues::U32(identities) = &piece.fields[0].data else {
            panic!("identities expected")
        };
        assert_eq!(identities[..], [0, 1, 2, 3, 4]);
        let FieldValues::F64(pressures) = &piece.fields[1].data else {
            panic!("reals expected")
        };
        assert_eq!(pressures[..], [0.0, 10.0, 20.0, 30.0, 40.0]);
    }

    #[test]
    fn shares_that_do_not_fit_are_refused() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("fluid_000000.pvtu");
        write_share(folder.path(), &share(0, 1), (0, 0), 0.0).unwrap();
        write_pvtu(&path, &share(0, 1), 0, 2).unwrap();
        assert!(read_piece(&path).is_err(), "one share is missing");
        let mut other = share(1, 1);
        other.fields.pop();
        write_share(folder.path(), &other, (0, 1), 0.0).unwrap();
        let said = read_piece(&path).unwrap_err().to_string();
        assert!(said.contains("differ"), "{said}");
        write_share(folder.path(), &share(1, 1), (0, 1), 0.5).unwrap();
        let said = read_piece(&path).unwrap_err().to_string();
        assert!(said.contains("times"), "{said}");
    }
}
