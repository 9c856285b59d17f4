//! Schemas of scenes for editors: plugins of the binary among the keys.
//!
//! Definitions that plugins share are collected, and join those of the scene at its end.

use scene_text::for_editors;
use serde_json::{Map, Value as Json, json};

use crate::{PluginInfo, PluginKind};

/// Puts the plugins of a kind into the schema of their table, as its keys.
pub fn name_plugins(place: &mut Json, kind: &PluginKind, shared: &mut Map<String, Json>) {
    let plugins = (kind.plugins)().into_iter();
    let properties: Map<String, Json> = plugins
        .map(|p| (p.name.to_string(), plugin(kind.name, &p, shared)))
        .collect();
    place["properties"] = Json::Object(properties);
    place["additionalProperties"] = json!(false);
}

/// The schema of a plugin's parameters, its shared definitions moved to the scene's.
pub fn plugin(kind: &str, info: &PluginInfo, shared: &mut Map<String, Json>) -> Json {
    let mut schema = (info.schema)();
    if !schema.is_object() {
        schema = json!({ "type": "object" });
    }
    let prefix = format!("{kind}.{}.", info.name);
    renamed(&mut schema, &prefix);
    if let Some(Json::Object(own)) = schema.as_object_mut().and_then(|s| s.remove("$defs")) {
        shared.extend(
            own.into_iter()
                .map(|(name, def)| (format!("{prefix}{name}"), def)),
        );
    }
    if let Some(object) = schema.as_object_mut() {
        object.remove("$schema");
        object.insert("title".into(), json!(info.name));
        object.insert(
            "description".into(),
            json!(format!("{}. {}", info.summary, info.source)),
        );
    }
    schema
}

fn renamed(schema: &mut Json, prefix: &str) {
    match schema {
        Json::Object(object) => {
            for (key, value) in object.iter_mut() {
                match value {
                    Json::String(target) if key == "$ref" => {
                        if let Some(name) = target.strip_prefix("#/$defs/") {
                            *target = format!("#/$defs/{prefix}{name}");
                        }
                    }
                    other => renamed(other, prefix),
                }
            }
        }
        Json::Array(items) => items.iter_mut().for_each(|item| renamed(item, prefix)),
        _ => {}
    }
}

/// The schema of a scene under its title, with the shared definitions; numbers may also be strings with a unit.
pub fn finished(mut root: Json, title: &str, shared: Map<String, Json>) -> Json {
    if let Some(defs) = root.get_mut("$defs").and_then(Json::as_object_mut) {
        defs.extend(shared);
    }
    root["$schema"] = json!("https://json-schema.org/draft/2020-12/schema");
    root["title"] = json!(title);
    for_editors(&mut root);
    root
}
