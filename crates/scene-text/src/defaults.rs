//! Defaults of a schema for keys that are left out.

use serde_json::Value as Json;

/// The default of every property that has one, by name.
pub fn defaults(schema: &Json) -> Vec<(String, Json)> {
    let properties = schema.get("properties").and_then(Json::as_object);
    properties
        .into_iter()
        .flatten()
        .filter_map(|(name, p)| p.get("default").map(|d| (name.clone(), d.clone())))
        .collect()
}
