//! The schema in a form for editors, and its defaults.

use serde_json::{Value as Json, json};

/// Changes the schema of a scene into that of its text: numbers may be strings with a unit, and TOML has no null.
///
/// ```
/// use serde_json::json;
///
/// let mut schema = json!({ "type": ["number", "null"] });
/// scene_text::for_editors(&mut schema);
/// assert_eq!(schema, json!({ "type": ["number", "string"] }));
/// ```
pub fn for_editors(schema: &mut Json) {
    match schema {
        Json::Object(object) => {
            for key in ["anyOf", "oneOf"] {
                if let Some(Json::Array(options)) = object.get_mut(key) {
                    options.retain(|o| o.get("type") != Some(&json!("null")));
                }
            }
            if let Some(kind) = object.get_mut("type") {
                let kinds: Vec<Json> = match &*kind {
                    Json::Array(kinds) => kinds.iter().filter(|k| **k != "null").cloned().collect(),
                    one => vec![one.clone()],
                };
                *kind = match kinds.as_slice() {
                    [one] if one == "number" => json!(["number", "string"]),
                    [one] => one.clone(),
                    several => json!(several),
                };
            }
            object.values_mut().for_each(for_editors);
        }
        Json::Array(items) => items.iter_mut().for_each(for_editors),
        _ => {}
    }
}

/// The default of every property that has one, by name.
pub fn defaults(schema: &Json) -> Vec<(String, Json)> {
    let properties = schema.get("properties").and_then(Json::as_object);
    let default = |(name, p): (&String, &Json)| Some((name.clone(), p.get("default")?.clone()));
    properties
        .into_iter()
        .flatten()
        .filter_map(default)
        .collect()
}
