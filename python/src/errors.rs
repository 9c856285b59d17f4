//! What went wrong, as the exceptions of `sph._errors`.

use pyo3::prelude::*;
use sph_cli::library::Trouble;

use crate::functions;

/// An exception of a class of `sph._errors`, with a text and what a program is told.
fn exception(py: Python<'_>, class: &str, text: &str, json: &str) -> PyErr {
    let made = py
        .import("sph._errors")
        .and_then(|module| module.getattr(class))
        .and_then(|class| class.call1((text, json)));
    match made {
        Ok(error) => PyErr::from_value(error),
        Err(error) => error,
    }
}

/// The exception for what keeps a command from its end.
pub fn from_trouble(py: Python<'_>, trouble: &Trouble) -> PyErr {
    let class = match trouble {
        Trouble::Usage(_) => "UsageError",
        Trouble::Scene(_) => "SceneError",
        Trouble::Failed { .. } | Trouble::Interrupted | Trouble::Different => "RunError",
    };
    let text = trouble.text(false);
    exception(py, class, text.trim_end(), &trouble.json().to_string())
}

/// The exception for a run that does not come to its end, caused by that of a function of Python if one raised it.
pub fn from_run(py: Python<'_>, trouble: &Trouble) -> PyErr {
    caused(py, from_trouble(py, trouble))
}

/// An exception for a step that failed, or anything else without a place in a scene, with the same cause.
pub fn step(py: Python<'_>, error: &impl std::fmt::Display) -> PyErr {
    caused(
        py,
        exception(py, "RunError", &format!("error: {error}"), "null"),
    )
}

fn caused(py: Python<'_>, error: PyErr) -> PyErr {
    error.set_cause(py, functions::raised());
    error
}

/// An exception for what is not there or cannot be.
pub fn usage(py: Python<'_>, text: &str) -> PyErr {
    exception(py, "UsageError", text, "null")
}

/// An exception for a file.
pub fn file(py: Python<'_>, error: &impl std::fmt::Display) -> PyErr {
    exception(py, "FileError", &error.to_string(), "null")
}
