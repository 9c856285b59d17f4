//! `sph plugins`.

mod law_sample;
mod page;
mod picture;
mod snippet;

use serde_json::{Value as Json, json};
use sph_core::{
    Parameter, PluginInfo, PluginKind, RegistryError, comma_list, kinds, parameters, some_unit,
    suggestion,
};

use crate::terminal::{CommandOutput, Trouble, WIDTH, columns, paragraph, paragraphs, row};
use crate::tool_arguments::PluginArguments;

/// The kinds of plugins that can be drawn.
const LAWS: &str = "rheology";
const KERNELS: &str = "kernel";

pub fn command(arguments: &PluginArguments) -> Result<(), Trouble> {
    let kinds = kinds();
    let Some(kind) = &arguments.kind else {
        let all: Vec<Json> = kinds.iter().map(|k| kind_json(k)).collect();
        let text = match arguments.markdown {
            true => page::markdown(&kinds),
            false => {
                let kinds = kinds.iter().map(|kind| kind_text(kind) + "\n");
                kinds.collect::<String>()
                    + "sph plugins KIND NAME shows a plugin's parameters and a snippet for a scene\n"
            }
        };
        CommandOutput::new(&all, text).print(arguments.json);
        return Ok(());
    };
    let kind = find_kind(&kinds, kind)?;
    let plugins = arguments.names.iter().map(|name| find_plugin(kind, name));
    let plugins = plugins.collect::<Result<Vec<_>, _>>()?;
    if let Some(file) = &arguments.picture {
        return match kind.name {
            LAWS => picture::draw_laws(arguments, &plugins, file),
            KERNELS => picture::draw_kernels(arguments, &plugins, file),
            _ => Err(Trouble::usage(format!(
                "only laws and kernels can be drawn: sph plugins {LAWS} NAME --picture FILE"
            ))),
        };
    }
    let each = plugins.iter().map(|p| plugin_json(kind.name, p));
    let (text, json) = match plugins.as_slice() {
        [] => (kind_text(kind), kind_json(kind)),
        [only] => (plugin_text(kind, only), plugin_json(kind.name, only)),
        several => {
            let texts = several.iter().map(|p| plugin_text(kind, p));
            (texts.collect::<Vec<_>>().join("\n"), each.collect())
        }
    };
    CommandOutput { json, text }.print(arguments.json);
    Ok(())
}

fn find_kind<'k>(kinds: &[&'k PluginKind], name: &str) -> Result<&'k PluginKind, Trouble> {
    let found = kinds.iter().find(|k| k.name == name);
    let unknown = || {
        let names = || kinds.iter().map(|k| k.name);
        let (near, known) = (suggestion(name, names()), comma_list(names()));
        format!("there is no kind of plugin called `{name}`{near} (kinds: {known})")
    };
    Ok(found.ok_or_else(unknown)?)
}

fn find_plugin(kind: &PluginKind, name: &str) -> Result<PluginInfo, Trouble> {
    let plugins = (kind.plugins)();
    let found = plugins.iter().find(|p| p.name == name);
    let known = plugins.iter().map(|p| p.name);
    let unknown = || RegistryError::unknown(kind.name, name, known).to_string();
    Ok(*found.ok_or_else(unknown)?)
}

fn kind_text(kind: &PluginKind) -> String {
    let row = |p: &PluginInfo| {
        [p.name, p.summary, &dimensions(p, " "), p.provider]
            .map(String::from)
            .to_vec()
    };
    let rows = match (kind.plugins)() {
        none if none.is_empty() => "  none is registered in this binary\n".to_string(),
        plugins => columns(2, plugins.iter().map(row)),
    };
    let default = kind.default.map_or(String::new(), |name| {
        format!("; `{name}` if a scene names none")
    });
    format!("{}: {}{default}\n{rows}", kind.name, kind.purpose)
}

fn dimensions(plugin: &PluginInfo, between: &str) -> String {
    let each: Vec<String> = plugin.dimensions.iter().map(|d| format!("{d}D")).collect();
    each.join(between)
}

fn plugin_text(kind: &PluginKind, plugin: &PluginInfo) -> String {
    let schema = (plugin.schema)();
    let mut text = format!("{} {}: {}\n", kind.name, plugin.name, plugin.summary);
    let facts = [
        row("dimensions", dimensions(plugin, " ")),
        row("source", plugin.source),
        row("provider", plugin.provider),
    ];
    text.push_str(&columns(2, facts));
    if let Some(description) = schema.get("description").and_then(Json::as_str) {
        text.push('\n');
        text.push_str(&paragraphs(2, &prose(description)));
    }
    text.push_str("\nparameters\n");
    let all = parameters(&schema);
    if all.is_empty() {
        text.push_str("  none\n");
    }
    text.extend(all.iter().map(|p| parameter_text(p, &schema)));
    text.push_str("\nin a scene\n");
    for line in snippet::toml_lines(kind.name, plugin).lines() {
        text.push_str(format!("  {line}").trim_end());
        text.push('\n');
    }
    text
}

/// The paragraphs of a doc comment; examples are left to the snippet.
fn prose(description: &str) -> Vec<&str> {
    let texts = description.split("```").step_by(2);
    let parts = texts.flat_map(|t| t.split("\n\n")).map(str::trim);
    parts.filter(|p| !p.is_empty()).collect()
}

fn parameter_text(parameter: &Parameter, schema: &Json) -> String {
    let default = match (&parameter.default, required(schema, &parameter.name)) {
        (_, true) => "required".to_string(),
        (Some(value), _) if !value.is_null() => format!("default {value}"),
        _ => "optional".to_string(),
    };
    let (name, kind) = (&parameter.name, &parameter.kind);
    let unit = some_unit(&parameter.unit).map_or(String::new(), |unit| format!(", {unit}"));
    let mut text = format!("  {name} ({kind}{unit}; {default})\n");
    text.push_str(&paragraph(6, WIDTH, &parameter.meaning));
    for (k, choice) in snippet::choices_of(schema, name).iter().enumerate() {
        let lead = if k == 0 { "one of " } else { "or " };
        let colon = if choice.meaning.is_empty() { "" } else { ": " };
        let line = format!("{lead}{}{colon}{}", choice.value, choice.meaning);
        text.push_str(&paragraph(8, WIDTH, &line));
    }
    if !parameter.source.is_empty() {
        let source = format!("source: {}", parameter.source);
        text.push_str(&paragraph(6, WIDTH, &source));
    }
    text
}

fn required(schema: &Json, name: &str) -> bool {
    let listed = schema.get("required").and_then(Json::as_array);
    listed.into_iter().flatten().any(|r| r == name)
}

fn kind_json(kind: &PluginKind) -> Json {
    let plugins = (kind.plugins)();
    let plugins: Vec<Json> = plugins.iter().map(|p| plugin_json(kind.name, p)).collect();
    json!({ "kind": kind.name, "purpose": kind.purpose, "default": kind.default, "plugins": plugins })
}

fn plugin_json(kind: &str, plugin: &PluginInfo) -> Json {
    let schema = (plugin.schema)();
    let all = parameters(&schema).into_iter().map(|p| {
        let required = required(&schema, &p.name);
        let choices = snippet::choices_of(&schema, &p.name).into_iter();
        let choices: Vec<String> = choices.map(|c| c.value).collect();
        json!({
            "name": p.name, "type": p.kind, "unit": p.unit, "default": p.default,
            "required": required, "choices": choices, "meaning": p.meaning, "source": p.source,
        })
    });
    json!({
        "kind": kind,
        "name": plugin.name,
        "summary": plugin.summary,
        "source": plugin.source,
        "provider": plugin.provider,
        "dimensions": plugin.dimensions,
        "parameters": all.collect::<Vec<_>>(),
        "snippet": snippet::toml_lines(kind, plugin),
    })
}
