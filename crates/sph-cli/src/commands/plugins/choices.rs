//! The values that a parameter may have, where they are a few.

use serde_json::Value as Json;
use sph_core::{comma_list, node_of};

/// A value that a parameter may have.
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
    let entry = node_of(&node["items"], schema);
    let places = [parameter, node, entry].into_iter();
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
