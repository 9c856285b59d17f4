//! Tables that name a plugin, kept as they stand, and remarks on them before plugins are built.

use std::collections::BTreeMap;

use schemars::JsonSchema;
use serde::Deserialize;
use sph_core::{
    Place, PluginChoice, PluginKind, RegistryError, SceneProblem, conform, kind_of, kinds,
};
use toml::{Table, Value};

/// The keys that lead to the tables of plugins of a kind, `*` for any; none where scenes name them otherwise.
fn keys(kind: &PluginKind) -> Vec<&'static str> {
    match kind.place {
        Place::One | Place::Any => vec![kind.name],
        Place::InPhase => vec!["phase", "*", kind.name],
        Place::InWall => vec!["wall", "*", kind.name],
        Place::Solution => vec!["body", "*", "initial"],
        Place::Probe | Place::Elsewhere => Vec::new(),
    }
}

/// Tables that hold exactly one plugin, as the keys that lead to them.
fn single_tables() -> Vec<Vec<&'static str>> {
    let single = kinds().into_iter().filter(|kind| kind.place != Place::Any);
    single.map(keys).filter(|keys| !keys.is_empty()).collect()
}

inventory::submit! {
    scene_text::OnePlugin(single_tables)
}

/// Parameter tables by plugin name.
pub type Plugins = BTreeMap<String, Table>;

/// The schema of a table whose keys are those of a plugin.
pub(crate) type AnyTable = serde_json::Map<String, serde_json::Value>;

/// Form of [`Plugins`] in the schema.
pub(crate) type AnyPlugins = BTreeMap<String, AnyTable>;

/// A probe or gauge: the plugin's name and its parameters in one table.
#[derive(Deserialize, JsonSchema)]
pub(crate) struct Probe {
    /// Name of the plugin.
    #[allow(dead_code, reason = "read through the table")]
    kind: String,
}

/// The tables of a scene that hold plugins of a kind, with their paths; probes and references hold theirs otherwise.
pub(crate) fn holders<'t>(kind: &PluginKind, scene: &'t Table) -> Vec<(String, &'t Value)> {
    match keys(kind)[..] {
        [own] => {
            let held = scene.get(own).into_iter();
            held.map(|held| (own.to_string(), held)).collect()
        }
        [root, _, key] => {
            let named = scene.get(root).and_then(Value::as_table);
            let held = |(name, keys): (&String, &'t Value)| {
                Some((format!("{root}.{name}.{key}"), keys.get(key)?))
            };
            named.into_iter().flatten().filter_map(held).collect()
        }
        _ => Vec::new(),
    }
}

/// The plugins of such a table, as far as they are tables themselves.
pub(crate) fn in_table<'t, T: Into<Value> + Clone + 't>(
    kind: &'static str,
    held: impl IntoIterator<Item = (&'t String, &'t T)>,
    path: &str,
) -> Vec<PluginChoice> {
    let choice = |(name, table): (&String, &T)| {
        let Value::Table(table) = table.clone().into() else {
            return None;
        };
        let path = format!("{path}.{name}");
        Some(plugin_choice(
            kind,
            name.clone(),
            table,
            [path.clone(), path],
        ))
    };
    held.into_iter().filter_map(choice).collect()
}

/// The probes of `[probe]` or `[gauge]`: the name of each and its plugin.
pub(crate) fn probes<'t, T: Into<Value> + Clone + 't>(
    parent: &str,
    tables: impl IntoIterator<Item = (&'t String, &'t T)>,
) -> Vec<(String, PluginChoice)> {
    let choice = |(name, table): (&String, &T)| {
        let Value::Table(mut table) = table.clone().into() else {
            return None;
        };
        let Some(Value::String(kind)) = table.remove("kind") else {
            return None;
        };
        let path = format!("{parent}.{name}");
        let places = [path.clone(), format!("{path}.kind")];
        Some((name.clone(), plugin_choice("probe", kind, table, places)))
    };
    tables.into_iter().filter_map(choice).collect()
}

pub(crate) fn solutions(scene: &Table) -> Vec<PluginChoice> {
    let all = scene.get("reference").and_then(Value::as_table);
    let choice = |(reference, given): (&String, &Value)| {
        let parameters = given.get("parameters").and_then(Value::as_table);
        let parameters = parameters.cloned().unwrap_or_default();
        let name = given.get("solution")?.as_str()?.to_string();
        Some(solution(reference, name, parameters))
    };
    all.into_iter().flatten().filter_map(choice).collect()
}

/// The solution of a reference, by its name and parameters.
pub(crate) fn solution(reference: &str, name: String, table: Table) -> PluginChoice {
    let places = ["parameters", "solution"].map(|key| format!("reference.{reference}.{key}"));
    plugin_choice("solution", name, table, places)
}

fn plugin_choice(
    kind: &'static str,
    name: String,
    table: Table,
    [path, name_path]: [String; 2],
) -> PluginChoice {
    PluginChoice {
        kind,
        name,
        table,
        path,
        name_path,
    }
}

/// Of every plugin that a scene names: remarks on its parameters, and the faults of its name or of them.
pub(crate) fn of_plugins(scene: &Table) -> (Vec<SceneProblem>, Vec<SceneProblem>) {
    let (mut remarks, mut mistakes) = (Vec::new(), Vec::new());
    for choice in choices(scene) {
        match check(&choice) {
            Ok(found) => remarks.extend(found),
            Err(found) => mistakes.extend(found),
        }
    }
    (remarks, mistakes)
}

/// Remarks on the parameters of a plugin, or the faults of its name or of them.
fn check(choice: &PluginChoice) -> Result<Vec<SceneProblem>, Vec<SceneProblem>> {
    let kind = kind_of(choice.kind);
    let plugins = kind.map_or(Vec::new(), |kind| (kind.plugins)());
    if plugins.is_empty() {
        // A reader of scenes without any plugin of the kind, which builds none.
        return Ok(Vec::new());
    }
    let Some(plugin) = plugins.iter().find(|p| p.name == choice.name) else {
        let known = plugins.iter().map(|p| p.name);
        let error = RegistryError::unknown(choice.kind, &choice.name, known);
        return Err(choice.scene_problems(&error));
    };
    let mut table = Value::Table(choice.table.clone());
    let inside =
        |found: Vec<SceneProblem>| choice.scene_problems(&RegistryError::Parameters(found));
    conform(&mut table, &(plugin.schema)())
        .map(inside)
        .map_err(inside)
}

/// Every plugin that a scene names, in any form of the rest of the scene.
fn choices(scene: &Table) -> Vec<PluginChoice> {
    let mut all = Vec::new();
    for kind in kinds() {
        for (path, held) in holders(kind, scene) {
            let held = held.as_table().into_iter().flatten();
            all.extend(in_table(kind.name, held, &path));
        }
    }
    for parent in ["probe", "gauge"] {
        let tables = scene.get(parent).and_then(Value::as_table);
        let found = tables.map(|tables| probes(parent, tables));
        all.extend(found.into_iter().flatten().map(|(_, probe)| probe));
    }
    all.extend(solutions(scene));
    all
}
