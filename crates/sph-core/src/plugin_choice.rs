//! Plugins by their names.

use toml::Table;

use crate::{RegistryError, SceneProblem};

/// A plugin of the scene, with its parameters as they stand in the scene.
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
    pub fn scene_problems(&self, error: &RegistryError) -> Vec<SceneProblem> {
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
