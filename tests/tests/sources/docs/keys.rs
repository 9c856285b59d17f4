//! Keys and plugins that pages name are those of scenes.

use serde_json::Value as Json;

use crate::docs::documents;

/// Pages that lead from terms to keys.
const PAGES: [&str; 2] = ["docs/coming-from.md", "docs/glossary.md"];

/// The node that a reference, or an option of one, leads to.
fn target<'s>(mut node: &'s Json, schema: &'s Json) -> &'s Json {
    loop {
        let name = node["$ref"].as_str();
        match name.or_else(|| node["anyOf"][0]["$ref"].as_str()) {
            Some(name) => node = schema.pointer(&name[1..]).expect("a definition"),
            None => return node,
        }
    }
}

/// Whether the schema has a key, in which NAME and PLUGIN stand for any.
fn is_known(key: &str, schema: &Json) -> bool {
    let mut node = schema;
    for name in key.split('.') {
        let here = target(node, schema);
        node = match name {
            "NAME" => &here["additionalProperties"],
            "PLUGIN" => return here["properties"].is_object(),
            name => &here["properties"][name],
        };
        if node.is_null() {
            return false;
        }
    }
    true
}

#[test]
fn keys_and_plugins_of_the_pages_for_newcomers_are_known() {
    let schema = sph_scene::schema();
    let mut checked = 0;
    for (page, text) in documents() {
        if !PAGES.iter().any(|of| page.ends_with(of)) {
            continue;
        }
        for span in text.split('`').skip(1).step_by(2) {
            let key = span.trim_start_matches('[').trim_end_matches(']');
            let plain = |c: char| c.is_ascii_alphanumeric() || "._-".contains(c);
            let root = key.split_once('.').map(|(root, _)| root);
            let of_scene = root.is_some_and(|root| schema["properties"].get(root).is_some());
            if of_scene && key.chars().all(plain) {
                assert!(is_known(key, &schema), "{page:?}: {span}");
                checked += 1;
            }
        }
    }
    assert!(checked > 100, "{checked} keys");
    assert!(!is_known("phase.NAME.viscosity", &schema));
    assert!(!is_known("kernel.wendland", &schema));
}
