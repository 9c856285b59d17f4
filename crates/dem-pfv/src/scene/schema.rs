//! The JSON schema of scenes of grains.

use serde_json::{Map, Value as Json, json};
use sph_core::{editors, kind_of, schema_of};

use crate::scene::tables::Scene;

/// The schema of the scene's own keys; tables of plugins are open in it.
pub(crate) fn of_scene() -> Json {
    schema_of::<Scene>()
}

/// Tables with one plugin at most, and the kind of it.
const PLUGINS: [(&str, &str); 6] = [
    ("/$defs/Grains/properties/contact", "contact-law"),
    ("/$defs/Start/properties/contact", "contact-law"),
    ("/$defs/Start/properties/wall_contact", "contact-law"),
    ("/$defs/Box/properties/contact", "contact-law"),
    ("/$defs/Wall/properties/contact", "contact-law"),
    ("/$defs/Fluid/properties/conductance", "conductance"),
];

/// The schema for editors, with the plugins of this binary. Numbers may also be strings with a unit.
pub fn editor_schema() -> Json {
    let (mut root, mut shared) = (of_scene(), Map::new());
    for (place, kind) in PLUGINS {
        if let (Some(place), Some(kind)) = (root.pointer_mut(place), kind_of(kind)) {
            place["maxProperties"] = json!(1);
            editors::name_plugins(place, kind, &mut shared);
        }
    }
    editors::finished(root, "Scene of grains", shared)
}
