//! Kernels by name, outside of a flow.

use sph_core::{Registry, RegistryError};
use sph_neighbours::KernelEntry;
use toml::Table;

pub use sph_kernels::Kernel;

/// The kernel of that name.
///
/// # Errors
/// If there is no such kernel.
pub fn kernel(name: &str) -> Result<Box<dyn Kernel>, RegistryError> {
    let kernels = Registry::<KernelEntry>::discovered()?;
    (kernels.find(name)?.build)(&Table::new())
}
