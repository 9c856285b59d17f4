//! Columns of particles as arrays of numpy, and back.

use numpy::{PyArray1, PyArrayMethods, PyReadonlyArrayDyn, PyUntypedArrayMethods};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use sph_core::{AnyField, Field, FieldError, Index, Shape, Store, SymmetricTensor, Tensor, fields};

/// The numbers of a column.
pub enum Numbers {
    /// Reals.
    Real(Vec<f64>),
    /// Unsigned integers.
    Index(Vec<u32>),
}

/// The fields of `sph_core` that stages write where they are read.
const DERIVED: [AnyField; 15] = [
    fields::ACCELERATION.any(),
    fields::DENSITY.any(),
    fields::VOLUME.any(),
    fields::PRESSURE.any(),
    fields::VISCOSITY.any(),
    fields::VELOCITY_GRADIENT.any(),
    fields::STRAIN_RATE.any(),
    fields::EDDY_VISCOSITY.any(),
    fields::EFFECTIVE_PRESSURE.any(),
    fields::PORE_PRESSURE.any(),
    fields::ELASTIC_STRESS.any(),
    fields::CARRIED_STRESS.any(),
    fields::RENORMALISATION.any(),
    fields::DISPLACEMENT.any(),
    fields::VOID_FRACTION.any(),
];

/// The field of a name: one of the store, or one that a stage may write.
pub fn field_of<const D: usize>(store: &Store<D>, name: &str) -> Option<AnyField> {
    let known = store.fields().chain(DERIVED);
    known.into_iter().find(|f| f.name == name)
}

/// The numbers of a column, tuple after tuple.
///
/// # Errors
/// If the store does not have it.
pub fn numbers<const D: usize>(store: &Store<D>, field: AnyField) -> Result<Numbers, FieldError> {
    let flat = |v: Vec<f64>| Ok(Numbers::Real(v));
    match field.shape {
        Shape::Scalar => flat(store.get(field.scalar())?.to_vec()),
        Shape::Vector => {
            let vectors = store.get(field.vector())?;
            flat(vectors.iter().flatten().copied().collect())
        }
        Shape::Index => {
            let field: Field<Index> = Field::new(field.name, field.unit, field.meaning);
            Ok(Numbers::Index(store.get(field)?.to_vec()))
        }
        Shape::Tensor => {
            let field: Field<Tensor> = Field::new(field.name, field.unit, field.meaning);
            let rows = store.get(field)?.iter();
            // Row by row, while nalgebra keeps columns.
            flat(
                rows.flat_map(|g| (0..D * D).map(move |k| g[(k / D, k % D)]))
                    .collect(),
            )
        }
        Shape::SymmetricTensor => {
            let field: Field<SymmetricTensor> = Field::new(field.name, field.unit, field.meaning);
            flat(store.get(field)?.iter().flat_map(|t| t.0).collect())
        }
    }
}

/// Lengths of the axes of a column after the first.
pub fn axes(shape: Shape, dimension: usize) -> Vec<usize> {
    match shape {
        Shape::Scalar | Shape::Index => vec![],
        Shape::Vector => vec![dimension],
        Shape::Tensor => vec![dimension; 2],
        Shape::SymmetricTensor => vec![6],
    }
}

/// An array that takes the numbers over without a copy; `axes` are the lengths after the first.
pub fn array<'py>(
    py: Python<'py>,
    numbers: Numbers,
    axes: &[usize],
) -> PyResult<Bound<'py, PyAny>> {
    let per: usize = axes.iter().product();
    let shape = |length: usize| [&[length / per.max(1)], axes].concat();
    Ok(match numbers {
        Numbers::Real(v) => {
            let shape = shape(v.len());
            PyArray1::from_vec(py, v).reshape(shape)?.into_any()
        }
        Numbers::Index(v) => {
            let shape = shape(v.len());
            PyArray1::from_vec(py, v).reshape(shape)?.into_any()
        }
    })
}

/// The numbers of an array, or of what numpy makes one of; a single number, or one row, stands for all.
pub fn from_array(found: &Bound<'_, PyAny>, shape: &[usize]) -> PyResult<Vec<f64>> {
    let numpy = found.py().import("numpy")?;
    let reals = numpy.call_method1("asarray", (found, "float64"))?;
    let whole = numpy.call_method1("broadcast_to", (&reals, shape.to_vec()));
    let whole = whole.map_err(|_| {
        let has = reals.getattr("shape").map(|s| s.to_string());
        let has = has.unwrap_or_default();
        PyValueError::new_err(format!("expected an array of shape {shape:?}, got {has}"))
    })?;
    let whole = numpy.call_method1("ascontiguousarray", (whole,))?;
    let whole: PyReadonlyArrayDyn<'_, f64> = whole.extract()?;
    debug_assert!(whole.is_contiguous());
    Ok(whole.as_slice()?.to_vec())
}
