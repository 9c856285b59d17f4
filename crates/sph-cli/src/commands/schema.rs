//! `sph schema`.

use crate::terminal::{Trouble, console};

/// Prints the JSON schema of scenes with all plugins of this binary.
pub fn command(grains: bool) -> Result<(), Trouble> {
    console::json(&match grains {
        true => dem_pfv::scene::editor_schema(),
        false => sph_scene::schema(),
    });
    Ok(())
}
