//! The extension module `sph._sph`: what Python calls, and no more. Objects, documentation and pandas are in the
//! package in `package/sph`.
//!
//! Nothing is computed here: scenes are opened and run by [`sph_cli::library`], stepped by
//! [`sph_particles::Stepper`], files are read by [`sph_io`].

mod columns;
mod errors;
mod files;
mod force;
mod functions;
mod law;
mod probe;
mod runs;
mod scene;
mod simulation;
mod watch;

use pyo3::prelude::*;

/// The functions and classes of the module.
#[pymodule]
fn _sph(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add("__version__", env!("CARGO_PKG_VERSION"))?;
    module.add_function(wrap_pyfunction!(runs::check, module)?)?;
    module.add_function(wrap_pyfunction!(runs::explain, module)?)?;
    module.add_function(wrap_pyfunction!(runs::run, module)?)?;
    module.add_function(wrap_pyfunction!(runs::study, module)?)?;
    module.add_function(wrap_pyfunction!(runs::main, module)?)?;
    module.add_function(wrap_pyfunction!(files::read_vtu, module)?)?;
    module.add_function(wrap_pyfunction!(files::list_pvd, module)?)?;
    module.add_function(wrap_pyfunction!(files::read_table, module)?)?;
    module.add_function(wrap_pyfunction!(files::measure, module)?)?;
    module.add_function(wrap_pyfunction!(functions::costs, module)?)?;
    module.add_function(wrap_pyfunction!(functions::register, module)?)?;
    module.add_function(wrap_pyfunction!(functions::forget, module)?)?;
    module.add_function(wrap_pyfunction!(law::viscosities, module)?)?;
    module.add_function(wrap_pyfunction!(law::shear_stresses, module)?)?;
    module.add_class::<simulation::Simulation>()?;
    Ok(())
}
