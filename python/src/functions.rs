//! Functions of Python that a scene names, with what they cost.

use std::collections::BTreeMap;
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::time::Instant;

use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::PyDict;
use sph_core::{AnyField, StepError};
use sph_neighbours::World;

use crate::columns::{array, axes, from_array, numbers};

/// A function with its cost.
struct Function {
    call: Py<PyAny>,
    calls: u64,
    seconds: f64,
    error: Option<PyErr>,
}

static FUNCTIONS: Mutex<BTreeMap<String, Function>> = Mutex::new(BTreeMap::new());

fn functions() -> MutexGuard<'static, BTreeMap<String, Function>> {
    FUNCTIONS.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Gives a function the name by which a scene names it.
#[pyfunction]
pub fn register(name: String, function: Py<PyAny>) -> PyResult<()> {
    let mut all = functions();
    if all.contains_key(&name) {
        let why = format!("a run that goes on has a function `{name}` already");
        return Err(PyValueError::new_err(why));
    }
    let function = Function {
        call: function,
        calls: 0,
        seconds: 0.0,
        error: None,
    };
    all.insert(name, function);
    Ok(())
}

/// Takes the name away again.
#[pyfunction]
pub fn forget(name: &str) {
    let function = functions().remove(name);
    drop(function);
}

/// Calls and seconds of a function so far, what it waited for other threads of Python included.
#[pyfunction]
pub fn costs(name: &str) -> Option<(u64, f64)> {
    functions().get(name).map(|f| (f.calls, f.seconds))
}

/// The first exception that a function raised since the last question.
pub fn raised() -> Option<PyErr> {
    let mut all = functions();
    all.values_mut().find_map(|f| f.error.take())
}

/// Whether there is a function of that name.
pub fn known(name: &str) -> bool {
    functions().contains_key(name)
}

/// Calls `function(time, columns)` and gives the numbers that it returns, which has a shape.
///
/// # Errors
/// A column that is missing, an exception, a result of another shape or with numbers that are not finite.
pub fn call<const D: usize>(
    name: &str,
    world: &World<D>,
    fields: &[AnyField],
    shape: &[usize],
    finite: bool,
) -> Result<Vec<f64>, StepError> {
    let begun = Instant::now();
    let failed = |reason: String| StepError::Stage {
        stage: format!("python function `{name}`"),
        reason,
    };
    let mut columns = Vec::new();
    for field in fields {
        columns.push((
            field.name,
            axes(field.shape, D),
            numbers(&world.free, *field)?,
        ));
    }
    let called = Python::attach(|py| -> PyResult<Vec<f64>> {
        let function = functions().get(name).map(|f| f.call.clone_ref(py));
        let gone = || PyValueError::new_err("it is not registered any more");
        let function = function.ok_or_else(gone)?;
        let given = PyDict::new(py);
        for (name, axes, numbers) in columns {
            given.set_item(name, array(py, numbers, &axes)?)?;
        }
        let result = function.bind(py).call1((world.time, given))?;
        from_array(&result, shape)
    });
    let seconds = begun.elapsed().as_secs_f64();
    let mut all = functions();
    if let Some(function) = all.get_mut(name) {
        function.calls += 1;
        function.seconds += seconds;
    }
    let values = match called {
        Ok(values) => values,
        Err(error) => {
            let told = error.to_string();
            if let Some(function) = all.get_mut(name) {
                function.error.get_or_insert(error);
            }
            return Err(failed(told));
        }
    };
    match values.iter().position(|v| finite && !v.is_finite()) {
        Some(k) => Err(failed(format!("number {k} of its result is not finite"))),
        None => Ok(values),
    }
}
