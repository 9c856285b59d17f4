//! Tables that name a plugin, kept as they stand.

use std::collections::BTreeMap;

use schemars::JsonSchema;
use serde::Deserialize;
use sph_core::{KindInfo, Place, RegistryError, SceneProblem, kinds};
use toml::Table;

/// Tables that hold exactly one plugin, as the keys that lead to them.
fn single_tables() -> Vec<Vec<&'static str>> {
    let path = |kind: &'static KindInfo| match kind.place {
        Place::One => Some(vec![kind.name]),
        Place::InPhase => Some(vec!["phase", "*", kind.name]),
        Place::InWall => Some(vec!["wall", "*", kind.name]),
        Place::Solution => Some(vec!["body", "*", "initial"]),
        Place::Any | Place::Probe => None,
    };
    kinds().into_iter().filter_map(path).collect()
}

inventory::submit! {
    scene_text::OnePlugin(single_tables)
}

/// Parameter tables by plugin name.
pub type Plugins = BTreeMap<String, Table>;

/// What the schema says of a table whose keys a plugin knows.
pub(crate) type AnyTable = serde_json::Map<String, serde_json::Value>;

/// What the schema says of [`Plugins`].
pub(crate) type AnyPlugins = BTreeMap<String, AnyTable>;

/// A probe or gauge: the plugin's name and its parameters in one table.
#[derive(Deserialize, JsonSchema)]
pub(crate) struct Probe {
    /// Name of the plugin.
    #[allow(dead_code, reason = "read through the table")]
    kind: String,
}

/// A plugin that the scene asks for, with its parameters as they stand in the scene.
#[derive(Clone, Debug, PartialEq)]
pub struct PluginChoice {
    /// Kind of plugin: "kernel", "rheology", "probe", …
    pub kind: &'static str,
    /// Name of the plugin.
    pub name: String,
    /// Its parameters, unchecked.
    pub table: Table,
    /// Path of the parameter table in the scene.
    pub path: String,
    /// Path of the key or value that gives the plugin's name.
    pub name_path: String,
}

impl PluginChoice {
    /// A plugin with no parameters that the scene does not mention: a solver's default.
    pub fn default_of(kind: &'static str, name: &str) -> Self {
        PluginChoice {
            kind,
            name: name.to_string(),
            table: Table::new(),
            path: format!("{kind}.{name}"),
            name_path: format!("{kind}.{name}"),
        }
    }

    /// Turns the refusal of a registry or plugin into problems of the scene.
    pub fn blame(&self, error: &RegistryError) -> Vec<SceneProblem> {
        match error {
            RegistryError::Parameters(problems) => problems
                .iter()
                .map(|p| SceneProblem::new(self.inside(&p.path), p.message.clone()))
                .collect(),
            other => vec![SceneProblem::new(self.name_path.clone(), other.to_string())],
        }
    }

    /// The scene's path of a key of this plugin's table.
    pub fn inside(&self, key: &str) -> String {
        match key {
            "" => self.path.clone(),
            key if key.starts_with('[') => format!("{}{key}", self.path),
            key => format!("{}.{key}", self.path),
        }
    }
}

/// Every entry of a table of plugins, as choices.
pub(crate) fn several(kind: &'static str, plugins: &Plugins) -> Vec<PluginChoice> {
    let choice = |(name, table): (&String, &Table)| PluginChoice {
        table: table.clone(),
        ..PluginChoice::default_of(kind, name)
    };
    plugins.iter().map(choice).collect()
}

/// The only entry of a table of plugins, as a choice.
pub(crate) fn single(kind: &'static str, plugins: &Plugins, parent: &str) -> Option<PluginChoice> {
    let (name, table) = plugins.first_key_value()?;
    Some(PluginChoice {
        kind,
        name: name.clone(),
        table: table.clone(),
        path: format!("{parent}.{name}"),
        name_path: format!("{parent}.{name}"),
    })
}
