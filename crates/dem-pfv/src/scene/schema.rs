//! The JSON schema of scenes of grains.

use scene_text::for_editors;
use serde_json::{Map, Value as Json, json};
use sph_core::{PluginInfo, plugins_of};

use crate::flow::ConductanceEntry;
use crate::grains::ContactLawEntry;
use crate::scene::tables::Scene;

/// The schema of the scene's own keys; tables of plugins are open in it.
pub(crate) fn of_scene() -> Json {
    schemars::schema_for!(Scene).to_value()
}

/// The schema for editors, with the plugins of this binary. Numbers may also be strings with a unit.
pub fn editor_schema() -> Json {
    let mut root = of_scene();
    let mut shared = Map::new();
    let (laws, throats) = (
        plugins_of::<ContactLawEntry>(),
        plugins_of::<ConductanceEntry>(),
    );
    for owner in ["Grains", "Start", "Box", "Wall"] {
        let place = format!("/$defs/{owner}/properties/contact");
        plugins(root.pointer_mut(&place), &laws, &mut shared);
    }
    plugins(
        root.pointer_mut("/$defs/Fluid/properties/conductance"),
        &throats,
        &mut shared,
    );
    if let Some(defs) = root.get_mut("$defs").and_then(Json::as_object_mut) {
        defs.extend(shared);
    }
    root["$schema"] = json!("https://json-schema.org/draft/2020-12/schema");
    root["title"] = json!("Scene of grains");
    for_editors(&mut root);
    root
}

/// Plugins as the keys of a table.
fn plugins(place: Option<&mut Json>, all: &[PluginInfo], shared: &mut Map<String, Json>) {
    let Some(place) = place else { return };
    let mut properties = Map::new();
    for plugin in all {
        let mut schema = (plugin.schema)();
        lift(&mut schema, shared);
        schema["description"] = json!(format!("{}. {}", plugin.summary, plugin.source));
        properties.insert(plugin.name.to_string(), schema);
    }
    place["properties"] = Json::Object(properties);
    place["additionalProperties"] = json!(false);
    place["maxProperties"] = json!(1);
}

/// Moves definitions to those of the whole.
fn lift(schema: &mut Json, shared: &mut Map<String, Json>) {
    let Some(object) = schema.as_object_mut() else {
        return;
    };
    object.remove("$schema");
    if let Some(Json::Object(own)) = object.remove("$defs") {
        shared.extend(own);
    }
}
