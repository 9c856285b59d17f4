//! The values that a parameter may have, and a plugin as lines of a scene.

use serde_json::Value as Json;
use sph_core::{Parameter, Place, PluginInfo, comma_list, kind_of, node_of, parameters, some_unit};

use super::required;

/// The TOML lines that name a plugin, with all its parameters.
pub fn toml_lines(kind: &str, plugin: &PluginInfo) -> String {
    let name = plugin.name;
    let schema = (plugin.schema)();
    let keys = parameters(&schema);
    let keys: String = keys.iter().map(|p| key(p, &schema)).collect();
    match (kind_of(kind).map(|k| k.place), kind) {
        (Some(Place::InPhase), _) => format!("[phase.NAME.{kind}.{name}]\n{keys}"),
        (Some(Place::InWall), _) => format!("[wall.NAME.{kind}.{name}]\n{keys}"),
        (Some(Place::Solution), _) => format!(
            "[body.NAME.initial.{name}]      # as an initial state\n{keys}\n\
             [reference.NAME]               # as a reference\nfield = \"velocity\"\n\
             solution = \"{name}\"\n[reference.NAME.parameters]\n{keys}"
        ),
        (_, "probe") => format!("[probe.NAME]\nkind = \"{name}\"\n{keys}"),
        (_, "contact-law") => format!("[grains.contact.{name}]\n{keys}"),
        (_, "conductance") => format!("[fluid.conductance.{name}]\n{keys}"),
        _ => format!("[{kind}.{name}]\n{keys}"),
    }
}

/// `name = value   # unit`; optional keys without a default are commented out.
fn key(parameter: &Parameter, schema: &Json) -> String {
    let name = &parameter.name;
    let required = required(schema, name);
    let given = parameter.default.as_ref().filter(|d| !d.is_null());
    let value = match given {
        Some(default) => toml(default),
        None => example(&schema["properties"][name], schema),
    };
    let note = required.then_some("required");
    let notes = comma_list(some_unit(&parameter.unit).into_iter().chain(note));
    let hidden = match given.is_none() && !required {
        true => "# ",
        false => "",
    };
    match notes.is_empty() {
        true => format!("{hidden}{name} = {value}\n"),
        false => format!("{hidden}{name} = {value}   # {notes}\n"),
    }
}

fn toml(value: &Json) -> String {
    match value {
        Json::Array(items) => format!("[{}]", comma_list(items.iter().map(toml))),
        Json::Object(fields) => {
            let fields = fields.iter().filter(|(_, v)| !v.is_null());
            table(fields.map(|(k, v)| format!("{k} = {}", toml(v))))
        }
        other => other.to_string(),
    }
}

fn table(fields: impl Iterator<Item = String>) -> String {
    match comma_list(fields) {
        fields if fields.is_empty() => "{}".into(),
        fields => format!("{{ {fields} }}"),
    }
}

/// A value that a node of the schema `root` allows.
fn example(node: &Json, root: &Json) -> String {
    if let Some(given) = node["examples"].get(0) {
        return toml(given);
    }
    if let Some(only) = node.get("const").or_else(|| node["enum"].get(0)) {
        return toml(only);
    }
    let target = node["$ref"].as_str().and_then(|r| r.strip_prefix('#'));
    if let Some(target) = target.and_then(|t| root.pointer(t)) {
        return example(target, root);
    }
    let forms = ["anyOf", "oneOf", "allOf"].map(|form| node[form].as_array());
    let mut forms = forms.into_iter().flatten().flatten();
    if let Some(form) = forms.find(|form| form["type"] != "null") {
        return example(form, root);
    }
    match kind(node) {
        "boolean" => "true".into(),
        "array" => {
            let items = node["prefixItems"].as_array();
            let repeated = || {
                // A vector has as many components as the scene has dimensions.
                let vector = node["items"]["format"] == "double";
                let fewest = if vector { 2 } else { 1 };
                let count = node["minItems"].as_u64().unwrap_or(fewest);
                comma_list((0..count).map(|_| example(&node["items"], root)))
            };
            let each = items.map(|all| comma_list(all.iter().map(|i| example(i, root))));
            format!("[{}]", each.unwrap_or_else(repeated))
        }
        "object" => {
            let properties = node["properties"].as_object();
            let needed = |name: &str| required(node, name);
            let any = properties.is_some_and(|p| p.keys().any(|name| needed(name)));
            let shown = properties.into_iter().flatten();
            let shown = shown.filter(|(name, _)| needed(name) || !any);
            let shown = shown.take(if any { usize::MAX } else { 1 });
            table(shown.map(|(name, of)| format!("{name} = {}", example(of, root))))
        }
        number @ ("number" | "integer") => {
            let bound = |name: &str| node[name].as_f64();
            let least = bound("minimum").or(bound("exclusiveMinimum"));
            let most = bound("maximum").or(bound("exclusiveMaximum"));
            // Half-way where 1 is no value between the bounds, or one of them.
            let value = match (least, most) {
                (Some(least), Some(most)) if !(least < 1.0 && most > 1.0) => 0.5 * (least + most),
                (Some(least), None) if least >= 1.0 => least + 1.0,
                (None, Some(most)) if most <= 1.0 => most - 1.0,
                _ => 1.0,
            };
            match number {
                "integer" => format!("{value:.0}"),
                _ => format!("{value:?}"),
            }
        }
        _ => "\"…\"".into(),
    }
}

fn kind(node: &Json) -> &str {
    let kind = &node["type"];
    kind.as_str().or_else(|| kind[0].as_str()).unwrap_or("")
}

pub struct Choice {
    /// As a scene writes it: `"standard"`, or the table `{ regular = … }`.
    pub value: String,
    /// Meaning; empty if the schema has none.
    pub meaning: String,
}

/// The values of a parameter, or of the entries of its list; none if it is not one of a few.
pub fn choices_of(schema: &Json, name: &str) -> Vec<Choice> {
    let parameter = &schema["properties"][name];
    let node = node_of(parameter, schema);
    let places = [parameter, node, node_of(&node["items"], schema)].into_iter();
    let mut found = places.map(|place| listed(place, schema));
    let found = found.find(|choices| !choices.is_empty());
    found.unwrap_or_default()
}

fn listed(node: &Json, schema: &Json) -> Vec<Choice> {
    let plain = node["enum"].as_array().into_iter().flatten();
    let plain = plain.filter_map(|value| choice(value, &Json::Null));
    let forms = ["oneOf", "anyOf"].into_iter();
    let forms = forms.flat_map(|form| node[form].as_array().into_iter().flatten());
    let forms = forms.flat_map(|form| {
        let several = form["enum"].as_array().into_iter().flatten();
        let all = std::iter::once(&form["const"]).chain(several);
        let words = all.filter_map(|value| choice(value, form));
        words.chain(tagged(form, schema)).collect::<Vec<_>>()
    });
    plain.chain(forms).collect()
}

fn choice(value: &Json, form: &Json) -> Option<Choice> {
    Some(Choice {
        value: format!("\"{}\"", value.as_str()?),
        meaning: meaning(form),
    })
}

/// A form that is a table of one key.
fn tagged(form: &Json, schema: &Json) -> Option<Choice> {
    let [(key, inner)] = form["properties"].as_object()?.iter().collect::<Vec<_>>()[..] else {
        return None;
    };
    let inner = node_of(inner, schema)["properties"].as_object();
    let inner = match inner.filter(|keys| !keys.is_empty()) {
        None => "…".to_string(),
        Some(keys) => format!("{{ {} }}", comma_list(keys.keys())),
    };
    Some(Choice {
        value: format!("{{ {key} = {inner} }}"),
        meaning: meaning(form),
    })
}

fn meaning(form: &Json) -> String {
    let text = form["description"].as_str().unwrap_or_default();
    text.replace('\n', " ")
}

#[cfg(test)]
mod tests {
    use super::*;
    use sph_core::{conform, kinds};

    #[test]
    fn a_snippet_has_values_of_the_right_types() {
        let mut count = 0;
        for kind in kinds() {
            for plugin in (kind.plugins)() {
                let schema = (plugin.schema)();
                let all = parameters(&schema);
                let lines = all.iter().map(|parameter| key(parameter, &schema));
                let text: String = lines
                    .map(|l| l.trim_start_matches("# ").to_string())
                    .collect();
                let read: toml::Table = text.parse().unwrap_or_else(|e| panic!("{text}: {e}"));
                let found = conform(&mut read.into(), &schema);
                assert!(found.is_ok(), "{} {}: {found:?}", kind.name, plugin.name);
                count += all.len();
            }
        }
        assert!(count > 200, "only {count} parameters");
    }
}
