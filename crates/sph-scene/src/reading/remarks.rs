//! Remarks on plugins before they are built: on numbers beyond those of nature, and mistakes.

use sph_core::{PluginChoice, RegistryError, SceneProblem, conform, kind_of, kinds};
use toml::{Table, Value};

use crate::reading::plugins::{holders, in_table, probes, solutions};

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
