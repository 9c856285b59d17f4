//! Laws by name, sheared alone: the measurement of a rheometer.

use sph_core::{Registry, RegistryError};
use sph_rheology::RheologyEntry;
use toml::Table;

pub use sph_rheology::Rheology;
pub use sph_rheology::rheometer::{shear_stresses, viscosities};

/// The law of that name with the parameters of a table.
///
/// # Errors
/// If there is no such law, or a parameter is wrong.
pub fn law(name: &str, parameters: &Table) -> Result<Box<dyn Rheology>, RegistryError> {
    let laws = Registry::<RheologyEntry>::discovered()?;
    (laws.find(name)?.build)(parameters)
}
