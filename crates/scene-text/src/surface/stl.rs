//! STL files, ascii and binary.

use std::io::Cursor;
use std::path::Path;

use stl_io::{Triangle, create_stl_reader};

use crate::read_bytes;
use crate::surface::vector::{cross, dot, minus};

/// Most triangles of a file.
const TRIANGLES: usize = 5_000_000;
/// Bytes before the triangles of a binary file.
const HEADER: usize = 84;
/// Bytes of a triangle in a binary file.
const RECORD: usize = 50;
/// Longest file, bytes: an ascii file needs five times the room of a binary one.
const BYTES: u64 = 512 << 20;

/// The triangles of an STL file, each with corners of its own.
#[derive(Clone, Debug, PartialEq)]
pub struct StlFile {
    /// Corners, in the unit of the file.
    pub triangles: Vec<[[f64; 3]; 3]>,
    /// Number, from 1, of the first facet whose normal in the file is not that of its corners' order.
    pub odd: Option<usize>,
}

/// The surface in a file.
///
/// # Errors
/// A file that cannot be read, with the name of the file and the number of the facet.
pub fn read(path: &Path) -> Result<StlFile, String> {
    parse(read_bytes(path, BYTES)?, &path.display().to_string())
}

/// The same from the bytes of a file called `name`.
///
/// # Errors
/// As [`read`].
pub fn parse(bytes: Vec<u8>, name: &str) -> Result<StlFile, String> {
    let bytes = prepared(bytes).map_err(|why| format!("`{name}` {why}"))?;
    let mut cursor = Cursor::new(bytes);
    let reader = create_stl_reader(&mut cursor);
    let given = reader.map_err(|e| format!("`{name}` is no STL file: {e}"))?;
    let mut triangles = Vec::new();
    let mut odd = None;
    for (k, triangle) in given.enumerate() {
        let number = k + 1;
        let triangle = triangle.map_err(|e| format!("`{name}`, facet {number}: {e}"))?;
        if number > TRIANGLES {
            return Err(format!("`{name}` has more than {TRIANGLES} facets"));
        }
        let corners = triangle.vertices.map(|v| v.0.map(f64::from));
        if let Some(x) = corners.iter().flatten().find(|x| !x.is_finite()) {
            let why = format!("expected finite coordinates, found {x}");
            return Err(format!("`{name}`, facet {number}: {why}"));
        }
        if odd.is_none() && contradicts(&triangle, &corners) {
            odd = Some(number);
        }
        triangles.push(corners);
    }
    match triangles.is_empty() {
        true => Err(format!("`{name}` holds no facets")),
        false => Ok(StlFile { triangles, odd }),
    }
}

/// True if the normal in the file and that of the corners' order point to different sides.
fn contradicts(triangle: &Triangle, corners: &[[f64; 3]; 3]) -> bool {
    let [a, b, c] = corners;
    let normal = triangle.normal.0.map(f64::from);
    let right_hand = cross(&minus(b, a), &minus(c, a));
    let lengths = (dot(&normal, &normal) * dot(&right_hand, &right_hand)).sqrt();
    dot(&normal, &right_hand) < -0.5 * lengths
}

/// The bytes as the reader takes them.
///
/// It takes whatever begins with `solid` for ascii, though many programs begin binary files so,
/// and it stops at the end of the first of several solids.
fn prepared(mut bytes: Vec<u8>) -> Result<Vec<u8>, String> {
    let start = bytes.trim_ascii_start().get(..5);
    let solid = start.is_some_and(|start| start.eq_ignore_ascii_case(b"solid"));
    let declared = bytes.get(80..).and_then(|rest| rest.first_chunk());
    let declared = declared.map(|count| u32::from_le_bytes(*count) as usize);
    let needed = |count: usize| HEADER + RECORD * count;
    if solid && declared.is_none_or(|count| needed(count) != bytes.len()) {
        return joined(&bytes);
    }
    let Some(count) = declared else {
        return Err(format!(
            "is no STL file: it has {} bytes, and a binary one has {HEADER} before the first facet",
            bytes.len()
        ));
    };
    let room = (bytes.len() - HEADER) / RECORD;
    let declares = format!("declares {count} facets");
    if count > TRIANGLES {
        return Err(format!(
            "{declares}, more than {TRIANGLES}; it has room for {room}"
        ));
    }
    if count > room {
        return Err(format!("{declares} and ends after {room}: it is cut short"));
    }
    bytes[..80].fill(0);
    Ok(bytes)
}

/// All solids of an ascii file as one, in lower case.
fn joined(bytes: &[u8]) -> Result<Vec<u8>, String> {
    let mut text = b"solid all\n".to_vec();
    let mut ended = false;
    for line in bytes.split(|b| matches!(b, b'\n' | b'\r')) {
        let line = line.trim_ascii().to_ascii_lowercase();
        if line.starts_with(b"endsolid") {
            ended = true;
        } else if line.starts_with(b"solid") {
            ended = false;
        } else if !line.is_empty() {
            text.extend(line);
            text.push(b'\n');
        }
    }
    if !ended {
        return Err("is no whole STL file: `endsolid` is missing at its end".to_string());
    }
    text.extend(b"endsolid\n");
    Ok(text)
}
