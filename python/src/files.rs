//! What a run has written.

use std::path::PathBuf;

use numpy::{PyArray1, PyArrayMethods};
use pyo3::prelude::*;
use pyo3::types::PyDict;
use sph_io::{Cells, FieldData, FieldValues, Location};

use crate::errors;

/// A number per tuple, or several.
fn array<'py>(py: Python<'py>, field: FieldData<'static>) -> PyResult<Bound<'py, PyAny>> {
    let per = field.components;
    macro_rules! shaped {
        ($v:expr) => {{
            let v = $v.into_owned();
            let rows = v.len() / per.max(1);
            let flat = PyArray1::from_vec(py, v);
            match per {
                1 => flat.into_any(),
                _ => flat.reshape([rows, per])?.into_any(),
            }
        }};
    }
    Ok(match field.data {
        FieldValues::F64(v) => shaped!(v),
        FieldValues::U32(v) => shaped!(v),
        FieldValues::I64(v) => shaped!(v),
    })
}

/// A VTU file of a run: `time`, `points`, `point_data`, `cell_data` (arrays with units) and `cells`.
#[pyfunction]
pub fn read_vtu(py: Python<'_>, path: PathBuf) -> PyResult<Bound<'_, PyDict>> {
    let read = py.detach(|| sph_io::read_piece(&path));
    let (piece, time) = read.map_err(|e| errors::file(py, &e))?;
    let all = PyDict::new(py);
    all.set_item("name", piece.name.as_ref())?;
    all.set_item("time", time)?;
    let points: Vec<f64> = piece.points.as_flattened().to_vec();
    let rows = points.len() / 3;
    all.set_item("points", PyArray1::from_vec(py, points).reshape([rows, 3])?)?;
    let (per, corners) = match &piece.cells {
        Cells::Vertices => (1, (0..rows as u32).collect()),
        Cells::Segments(c) => (2, c.as_flattened().to_vec()),
        Cells::Triangles(c) => (3, c.as_flattened().to_vec()),
        Cells::Tetrahedra(c) => (4, c.as_flattened().to_vec()),
    };
    let count = corners.len() / per;
    all.set_item(
        "cells",
        PyArray1::from_vec(py, corners).reshape([count, per])?,
    )?;
    let (at_points, at_cells) = (PyDict::new(py), PyDict::new(py));
    for field in piece.fields {
        let into = match field.location {
            Location::Point => &at_points,
            Location::Cell => &at_cells,
        };
        let (name, unit) = (field.name.to_string(), field.unit.to_string());
        into.set_item(name, (array(py, field)?, unit))?;
    }
    all.set_item("point_data", at_points)?;
    all.set_item("cell_data", at_cells)?;
    Ok(all)
}

/// Time (s), name and file of every piece that a `.pvd` lists.
#[pyfunction]
pub fn list_pvd(py: Python<'_>, path: PathBuf) -> PyResult<Vec<(f64, String, PathBuf)>> {
    let listed = sph_io::list_pvd(&path).map_err(|e| errors::file(py, &e))?;
    Ok(listed
        .into_iter()
        .map(|l| (l.time, l.name, l.path))
        .collect())
}

/// A column of a table: its name, its unit and its values.
type NamedColumn<'py> = (String, String, Bound<'py, PyArray1<f64>>);

/// `sph measure` with its arguments as JSON: name, unit and values of every column.
#[pyfunction]
pub fn measure(py: Python<'_>, arguments: String) -> PyResult<Vec<NamedColumn<'_>>> {
    let table = py.detach(|| sph_cli::library::measure(&arguments));
    let table = table.map_err(|t| errors::from_trouble(py, &t))?;
    let columns = table.columns.into_iter().enumerate();
    let values = |k: usize| table.rows.iter().map(|row| row[k]).collect();
    Ok(columns
        .map(|(k, (name, unit))| (name, unit, PyArray1::from_vec(py, values(k))))
        .collect())
}

/// Name, unit and values of every column of a table.
#[pyfunction]
pub fn read_table(py: Python<'_>, path: PathBuf) -> PyResult<Vec<NamedColumn<'_>>> {
    let table = sph_io::read_table(&path).map_err(|e| errors::file(py, &e))?;
    let columns = table.columns.into_iter();
    Ok(columns
        .map(|c| (c.name, c.unit, PyArray1::from_vec(py, c.values)))
        .collect())
}
