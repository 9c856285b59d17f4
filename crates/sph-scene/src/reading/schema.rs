//! The JSON schema of a whole scene, with every plugin of the binary, for editors.

use scene_text::resolved;
use serde_json::{Map, Value as Json, json};
use sph_core::{Place, PluginKind, editors, kinds, schema_of};

use crate::Scene;
use crate::reading::plugins::AnyPlugins;

/// The schema of scenes.
///
/// Where a scene names a plugin, the plugins registered in this binary stand with their
/// parameters. Numbers may also be strings with a unit.
pub fn schema() -> Json {
    let mut root = of_scene();
    let mut shared = Map::new();
    for kind in kinds() {
        insert(&mut root, kind, &mut shared);
    }
    editors::finished(root, "SPH scene", shared)
}

/// The schema of the scene's own tables, and of those that name plugins, whose keys are open.
pub(crate) fn of_scene() -> Json {
    let mut root = schema_of::<Scene>();
    let Some(properties) = root.get_mut("properties").and_then(Json::as_object_mut) else {
        return root;
    };
    for kind in kinds().into_iter().filter(|k| k.has_table()) {
        let mut place = schema_of::<AnyPlugins>();
        let (name, purpose, absent) = (kind.name, kind.purpose, kind.if_left_out());
        place["description"] = json!(format!("{purpose}, `[{name}.PLUGIN]`; {absent}"));
        if kind.place == Place::One {
            place["maxProperties"] = json!(1);
        }
        for key in ["$schema", "title"] {
            place.as_object_mut().and_then(|place| place.remove(key));
        }
        properties.insert(name.to_string(), place);
    }
    root
}

/// SI unit of a scene's own key, `numerics.spacing`; none for parameters of plugins.
pub fn unit(key: &str) -> Option<String> {
    let root = schema_of::<Scene>();
    let mut here = &root;
    for part in key.split('.') {
        let table = resolved(&root, here);
        let named = table.get("properties").and_then(|p| p.get(part));
        here = named.or_else(|| table.get("additionalProperties"))?;
    }
    here.get("unit").and_then(Json::as_str).map(String::from)
}

fn insert(root: &mut Json, kind: &PluginKind, shared: &mut Map<String, Json>) {
    let name = kind.name;
    let owner = match kind.place {
        Place::InPhase => format!("/$defs/Phase/properties/{name}"),
        Place::InWall => format!("/$defs/Wall/properties/{name}"),
        // A solution is also an initial state.
        Place::Solution => {
            solutions(root, kind, shared);
            "/$defs/Body/properties/initial".into()
        }
        Place::One | Place::Any => format!("/properties/{name}"),
        Place::Probe => {
            let all = json!({ "oneOf": tagged(kind, shared) });
            for table in ["probe", "gauge"] {
                if let Some(place) = root.pointer_mut(&format!("/properties/{table}")) {
                    place["additionalProperties"] = all.clone();
                }
            }
            return;
        }
        Place::Elsewhere => return,
    };
    if let Some(place) = root.pointer_mut(&owner) {
        editors::name_plugins(place, kind, shared);
    }
}

/// Plugins as alternatives that the key `kind` distinguishes.
fn tagged(kind: &PluginKind, shared: &mut Map<String, Json>) -> Vec<Json> {
    let alternative = |p: sph_core::PluginInfo| {
        let mut schema = editors::plugin(kind.name, &p, shared);
        schema["properties"]["kind"] = json!({ "const": p.name, "description": p.summary });
        let mut required = schema["required"].as_array().cloned().unwrap_or_default();
        required.push(json!("kind"));
        schema["required"] = Json::Array(required);
        schema
    };
    (kind.plugins)().into_iter().map(alternative).collect()
}

/// Names of reference solutions, and the parameters that go with each name.
fn solutions(root: &mut Json, kind: &PluginKind, shared: &mut Map<String, Json>) {
    let plugins = (kind.plugins)();
    let Some(place) = root.pointer_mut("/$defs/Reference") else {
        return;
    };
    let names: Vec<&str> = plugins.iter().map(|p| p.name).collect();
    place["properties"]["solution"]["enum"] = json!(names);
    let rules = plugins.iter().map(|p| {
        json!({
            "if": { "required": ["solution"], "properties": { "solution": { "const": p.name } } },
            "then": { "properties": { "parameters": editors::plugin(kind.name, p, shared) } },
        })
    });
    place["allOf"] = rules.collect();
}
