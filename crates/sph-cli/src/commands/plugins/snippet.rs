//! How a plugin is written into a scene.

use serde_json::Value as Json;
use sph_core::{Parameter, PluginInfo, parameters};

use super::{choices, required};

/// The TOML lines that name a plugin, with all its parameters.
pub fn of(kind: &str, plugin: &PluginInfo) -> String {
    let name = plugin.name;
    let schema = (plugin.schema)();
    let keys: String = parameters(&schema)
        .iter()
        .map(|p| key(p, &schema))
        .collect();
    match kind {
        "equation-of-state" | "rheology" => format!("[phase.NAME.{kind}.{name}]\n{keys}"),
        "probe" => format!("[probe.NAME]\nkind = \"{name}\"\n{keys}"),
        "solution" => format!(
            "[body.NAME.initial.{name}]      # as an initial state\n{keys}\n\
             [reference.NAME]               # as a reference\nfield = \"velocity\"\n\
             solution = \"{name}\"\n[reference.NAME.parameters]\n{keys}"
        ),
        "contact-law" => format!("[grains.contact.{name}]\n{keys}"),
        "conductance" => format!("[fluid.conductance.{name}]\n{keys}"),
        _ => format!("[{kind}.{name}]\n{keys}"),
    }
}

/// `name = value   # unit`; what may be left out and has no default is commented out.
fn key(parameter: &Parameter, schema: &Json) -> String {
    let name = &parameter.name;
    let required = required(schema, name);
    let first = choices(schema, name).into_iter().next();
    let given = parameter.default.as_ref().filter(|d| !d.is_null());
    let placeholder = || first.unwrap_or_else(|| placeholder(&parameter.kind).to_string());
    let value = given.map_or_else(placeholder, Json::to_string);
    let unit = match parameter.unit.as_str() {
        "" | "1" => None,
        unit => Some(unit),
    };
    let note = if required { Some("required") } else { None };
    let notes: Vec<&str> = [unit, note].into_iter().flatten().collect();
    let hidden = if given.is_none() && !required {
        "# "
    } else {
        ""
    };
    match notes.is_empty() {
        true => format!("{hidden}{name} = {value}\n"),
        false => format!("{hidden}{name} = {value}   # {}\n", notes.join(", ")),
    }
}

fn placeholder(kind: &str) -> &'static str {
    match kind {
        "number" => "1.0",
        "integer" => "1",
        "boolean" => "true",
        "array" => "[0.0, 0.0]",
        _ => "\"…\"",
    }
}
