//! Laws sheared alone.

use numpy::{PyArray1, PyReadonlyArray1};
use pyo3::prelude::*;
use sph_solver::rheometer::{self, Rheology};

use crate::errors;

/// A law by its name with the parameters of a TOML text.
fn law(py: Python<'_>, name: &str, parameters: &str) -> PyResult<Box<dyn Rheology>> {
    let wrong = |text: String| errors::usage(py, &format!("rheology {name}: {text}"));
    let table = parameters.parse();
    let table: toml::Table = table.map_err(|e: toml::de::Error| wrong(e.to_string()))?;
    rheometer::law(name, &table).map_err(|e| match e {
        sph_core::RegistryError::Parameters(problems) => {
            let each = problems.iter().map(|p| match p.path.as_str() {
                "" => p.message.clone(),
                path => format!("{path}: {}", p.message),
            });
            wrong(each.collect::<Vec<_>>().join("; "))
        }
        other => errors::usage(py, &other.to_string()),
    })
}

/// Effective viscosities (Pa s) at strain rates (1/s) and one pressure (Pa).
#[pyfunction]
pub fn viscosities<'py>(
    py: Python<'py>,
    name: &str,
    parameters: &str,
    pressure: f64,
    strain_rates: PyReadonlyArray1<'py, f64>,
) -> PyResult<Bound<'py, PyArray1<f64>>> {
    let law = law(py, name, parameters)?;
    let rates = strain_rates.as_slice()?;
    let found = rheometer::viscosities(&*law, pressure, rates);
    Ok(PyArray1::from_vec(py, found))
}

/// Shear stresses (Pa) of a shear at a constant rate (1/s) from rest, at rising strains and one pressure (Pa).
#[pyfunction]
pub fn shear_stresses<'py>(
    py: Python<'py>,
    name: &str,
    parameters: &str,
    pressure: f64,
    strain_rate: f64,
    strains: PyReadonlyArray1<'py, f64>,
) -> PyResult<Bound<'py, PyArray1<f64>>> {
    let law = law(py, name, parameters)?;
    let found = rheometer::shear_stresses(&*law, pressure, strain_rate, strains.as_slice()?);
    Ok(PyArray1::from_vec(py, found))
}
