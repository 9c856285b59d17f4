//! `sph schema`.

use crate::arguments::SchemaArguments;
use crate::terminal::console;
use crate::terminal::trouble::Trouble;

/// Prints the JSON schema of scenes with all plugins of this binary.
pub fn command(arguments: &SchemaArguments) -> Result<(), Trouble> {
    match arguments.grains {
        true => console::json(&dem_pfv::scene::editor_schema()),
        false => console::json(&sph_scene::schema()),
    }
    Ok(())
}
