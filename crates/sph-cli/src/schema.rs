//! `sph schema`.

use crate::console;
use crate::trouble::Trouble;

/// Prints the JSON schema of scenes with all plugins of this binary.
pub fn command() -> Result<(), Trouble> {
    console::json(&sph_scene::schema());
    Ok(())
}
