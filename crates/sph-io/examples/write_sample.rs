//! Writes a small time series for ParaView, and what a reader must find in it.
//!
//! `cargo run -p sph-io --example write_sample -- DIR` leaves `fields.pvd`, its
//! data files, `expected.json` and `fluid_….velocity.csv`;
//! `python3 tests/read_back.py DIR` compares them through VTK.

use std::collections::BTreeMap;
use std::error::Error;
use std::path::Path;

use serde::Serialize;
use sph_io::{
    Cells, FieldData, FieldValues, Frame, Location, Piece, PvdSeries, SeriesWriter, writable,
    write_json,
};

/// What a reader must find in one file.
#[derive(Serialize)]
struct Expected {
    file: String,
    time: f64,
    points: usize,
    cells: usize,
    point_arrays: BTreeMap<String, (usize, String)>,
    cell_arrays: BTreeMap<String, (usize, String)>,
}

fn main() -> Result<(), Box<dyn Error>> {
    let folder = std::env::args().nth(1).ok_or("usage: write_sample DIR")?;
    let folder = Path::new(&folder);
    writable(folder)?;
    let mut series = PvdSeries::create(folder.join("fields.pvd"))?;
    let mut expected = Vec::new();
    for index in 0..3 {
        let time = 0.1 * index as f64;
        // The last frame has arrays of several compressed blocks.
        let side = [7, 40, 260][index];
        let points = block(side);
        let velocity: Vec<[f64; 3]> = points.iter().map(|p| whirl(*p, time)).collect();
        let frame = Frame {
            time,
            index,
            pieces: vec![fluid(&points, &velocity), walls(), gate(), no_drops()],
        };
        let files = series.write(&frame, 1)?;
        for (piece, file) in frame.pieces.iter().zip(&files) {
            let file = file.strip_prefix(folder)?.display().to_string();
            expected.push(expectation(piece, file, time));
        }
        dump(folder, &files[0], &velocity)?;
    }
    write_json(folder.join("expected.json"), &expected)?;
    Ok(())
}

/// Particles of a square of 1 m.
fn block(side: usize) -> Vec<[f64; 3]> {
    let at = |i: usize| (i as f64 + 0.5) / side as f64;
    let place = |i| [at(i % side), at(i / side), 0.0];
    (0..side * side).map(place).collect()
}

/// Rigid rotation that slows down.
fn whirl([x, y, _]: [f64; 3], time: f64) -> [f64; 3] {
    let rate = (-time).exp();
    [-rate * (y - 0.5), rate * (x - 0.5), 0.0]
}

fn fluid<'a>(points: &'a [[f64; 3]], velocity: &'a [[f64; 3]]) -> Piece<'a> {
    let pressure: Vec<f64> = points.iter().map(|p| 9810.0 * (1.0 - p[1])).collect();
    let stress: Vec<f64> = pressure
        .iter()
        .flat_map(|&p| [-p, -p, -p, 0.1 * p, 0.0, 0.0])
        .collect();
    let id: Vec<u32> = (0..points.len() as u32).collect();
    let key: Vec<i64> = id.iter().map(|&i| -(i64::from(i) << 33)).collect();
    Piece {
        name: "fluid".into(),
        points: points.into(),
        cells: Cells::Vertices,
        fields: vec![
            FieldData::tensor("velocity", "m/s", 3, velocity.as_flattened()),
            FieldData::scalar("pressure", "Pa", pressure),
            FieldData::integer("id", id),
            FieldData {
                name: "stress".into(),
                unit: "Pa".into(),
                location: Location::Point,
                components: 6,
                data: FieldValues::F64(stress.into()),
            },
            FieldData {
                name: "key".into(),
                unit: "".into(),
                location: Location::Point,
                components: 1,
                data: FieldValues::I64(key.into()),
            },
        ],
    }
}

/// A polyline with normals on its segments.
fn walls() -> Piece<'static> {
    let corners = [[0.0, 1.0], [0.0, 0.0], [1.0, 0.0], [1.0, 1.0]];
    let points: Vec<[f64; 3]> = corners.iter().map(|c| [c[0], c[1], 0.0]).collect();
    let normals = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [-1.0, 0.0, 0.0]].concat();
    Piece {
        name: "walls & <floor>".into(),
        points: points.into(),
        cells: Cells::Segments(vec![[0, 1], [1, 2], [2, 3]].into()),
        fields: vec![
            FieldData::tensor("normal", "", 3, normals).at_cells(),
            FieldData::scalar("gamma", "", vec![0.5, 0.25, 0.25, 0.5]),
        ],
    }
}

/// Two triangles.
fn gate() -> Piece<'static> {
    let corners = [[1.0, 0.0], [1.0, 1.0]];
    let corner = |z: f64| corners.map(|[x, y]| [x, y, z]);
    let points = [corner(0.0), corner(1.0)].concat();
    Piece {
        name: "gate".into(),
        points: points.into(),
        cells: Cells::Triangles(vec![[0, 1, 3], [0, 3, 2]].into()),
        fields: vec![FieldData::scalar("area", "m²", vec![0.5, 0.5]).at_cells()],
    }
}

/// A piece may have nothing in it yet.
fn no_drops() -> Piece<'static> {
    Piece {
        name: "drops".into(),
        points: vec![].into(),
        cells: Cells::Vertices,
        fields: vec![FieldData::scalar("pressure", "Pa", vec![])],
    }
}

fn expectation(piece: &Piece, file: String, time: f64) -> Expected {
    let arrays = |location| {
        let here = piece.fields.iter().filter(|f| f.location == location);
        here.map(|f| (f.name.to_string(), (f.components, f.unit.to_string())))
            .collect()
    };
    Expected {
        file,
        time,
        points: piece.points.len(),
        cells: piece.cells.len(piece.points.len()),
        point_arrays: arrays(Location::Point),
        cell_arrays: arrays(Location::Cell),
    }
}

/// The velocities as plain text beside the file they are in.
fn dump(folder: &Path, file: &Path, velocity: &[[f64; 3]]) -> Result<(), Box<dyn Error>> {
    let stem = file.file_stem().unwrap_or_default().to_string_lossy();
    let path = folder.join(format!("{stem}.velocity.csv"));
    let columns = ["x", "y", "z"].map(|name| (name, "m/s"));
    let mut table = SeriesWriter::create(path, columns)?;
    for row in velocity {
        table.row(row)?;
    }
    Ok(())
}
