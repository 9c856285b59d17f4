//! From what Python calls a scene to an opened one.

use std::path::PathBuf;

use pyo3::exceptions::{PyTypeError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::{PyBool, PyDict, PyFloat, PyInt, PyList, PyMapping, PySequence, PyString};
use sph_cli::library::{OpenScene, SceneArguments, open, open_text};
use toml::{Table, Value};

use crate::errors;

/// How deep tables and lists may lie in each other.
const DEEPEST: usize = 64;

/// Opens a scene: a path or the name of a shipped scene, a text with several lines, or a dict.
pub fn opened(
    scene: &Bound<'_, PyAny>,
    set: Vec<String>,
    allow_path: Vec<PathBuf>,
) -> PyResult<OpenScene> {
    let py = scene.py();
    let told = |t| errors::from_trouble(py, &t);
    let named = |scene| SceneArguments {
        scene,
        set,
        allow_path,
    };
    if let Ok(dict) = scene.cast::<PyDict>() {
        let table = table(dict.as_mapping(), 0)?;
        let text = toml::to_string_pretty(&table);
        let text = text.map_err(|e| PyValueError::new_err(format!("the dict is no scene: {e}")))?;
        return open_text(&text, "dict.toml", &named("dict.toml".into())).map_err(told);
    }
    let path = py.import("os")?.call_method1("fspath", (scene,));
    let path: String = path?.extract()?;
    match path.contains('\n') {
        true => open_text(&path, "text.toml", &named("text.toml".into())).map_err(told),
        false => open(&named(path)).map_err(told),
    }
}

fn table(dict: &Bound<'_, PyMapping>, depth: usize) -> PyResult<Table> {
    let mut table = Table::new();
    for item in dict.items()?.iter() {
        let (key, found): (Bound<'_, PyAny>, Bound<'_, PyAny>) = item.extract()?;
        let key: String = key.str()?.extract()?;
        // As in a text, a key that is left out is one that is not there.
        if !found.is_none() {
            table.insert(key, value(&found, depth + 1)?);
        }
    }
    Ok(table)
}

/// Numbers of numpy are converted like those of Python, arrays like lists.
fn value(found: &Bound<'_, PyAny>, depth: usize) -> PyResult<Value> {
    if depth > DEEPEST {
        return Err(PyValueError::new_err("the dict is nested too deeply"));
    }
    if found.is_instance_of::<PyBool>() {
        return Ok(Value::Boolean(found.extract()?));
    }
    if found.is_instance_of::<PyString>() {
        return Ok(Value::String(found.extract()?));
    }
    if found.is_instance_of::<PyInt>() {
        return Ok(Value::Integer(found.extract()?));
    }
    if found.is_instance_of::<PyFloat>() {
        return Ok(Value::Float(found.extract()?));
    }
    if let Ok(mapping) = found.cast::<PyMapping>() {
        return Ok(Value::Table(table(mapping, depth)?));
    }
    if found.hasattr("tolist")? {
        return value(&found.call_method0("tolist")?, depth + 1);
    }
    if let Ok(sequence) = found.cast::<PySequence>() {
        let list: Bound<'_, PyList> = sequence.to_list()?;
        let all = list.iter().map(|item| value(&item, depth + 1));
        return Ok(Value::Array(all.collect::<PyResult<_>>()?));
    }
    if found.hasattr("__fspath__")? {
        let path = found.py().import("os")?.call_method1("fspath", (found,))?;
        return Ok(Value::String(path.extract()?));
    }
    Err(PyTypeError::new_err(format!(
        "a scene holds numbers, texts, lists and dicts, not {}",
        found.get_type().name()?
    )))
}
