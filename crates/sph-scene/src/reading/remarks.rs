//! What is to be said of plugins before they are built: remarks on numbers that nature does not have, and mistakes.

use scene_text::suggestion;
use sph_core::{PluginInfo, RegistryError, SceneProblem, conform, contracts, kinds};
use toml::{Table, Value};

use crate::Scene;
use crate::reading::plugins::{PluginChoice, Plugins, several};

/// What is to be said of the parameters of every plugin that is known by its name; those that are wrong are left
/// to whoever builds it.
pub(crate) fn of_plugins(scene: &Scene) -> Vec<SceneProblem> {
    let checked = choices(scene).into_iter().map(|c| check(&c));
    checked.filter_map(Result::ok).flatten().collect()
}

/// Names and parameters that are wrong, for a scene that is refused for another reason: all is told at once.
pub(crate) fn mistakes(scene: &Scene) -> Vec<SceneProblem> {
    let checked = choices(scene).into_iter().map(|c| check(&c));
    checked.filter_map(Result::err).flatten().collect()
}

/// The same for a table that is no scene, of the plugins with a table of the scene's own.
pub(crate) fn mistakes_in_tables(table: &Table) -> Vec<SceneProblem> {
    let mut found = Vec::new();
    for kind in kinds().into_iter().filter(|k| k.has_table()) {
        let Some(Ok(plugins)) = table
            .get(kind.name)
            .map(|t| t.clone().try_into::<Plugins>())
        else {
            continue;
        };
        let checked = several(kind.name, &plugins).into_iter().map(|c| check(&c));
        found.extend(checked.filter_map(Result::err).flatten());
    }
    found
}

/// Remarks on the parameters of a plugin, or what is wrong with its name or with them.
fn check(choice: &PluginChoice) -> Result<Vec<SceneProblem>, Vec<SceneProblem>> {
    let kind = contracts().into_iter().find(|c| c.kind == choice.kind);
    let plugins = kind.map_or(Vec::new(), |c| (c.plugins)());
    if plugins.is_empty() {
        // A reader of scenes without any plugin of the kind, which builds none.
        return Ok(Vec::new());
    }
    let Some(plugin) = plugins.iter().find(|p| p.name == choice.name) else {
        return Err(choice.blame(&unknown(choice, &plugins)));
    };
    let mut table = Value::Table(choice.table.clone());
    let inside = |found: Vec<SceneProblem>| choice.blame(&RegistryError::Parameters(found));
    conform(&mut table, &(plugin.schema)())
        .map(inside)
        .map_err(inside)
}

fn unknown(choice: &PluginChoice, plugins: &[PluginInfo]) -> RegistryError {
    let names = || plugins.iter().map(|p| p.name);
    RegistryError::Unknown {
        kind: choice.kind,
        name: choice.name.clone(),
        hint: suggestion(&choice.name, names()),
        known: names().collect::<Vec<_>>().join(", "),
    }
}

/// Every plugin that the scene names.
fn choices(scene: &Scene) -> Vec<PluginChoice> {
    let named = kinds().into_iter().flat_map(|k| scene.choices(k.name));
    let mut all: Vec<_> = named.collect();
    for phase in scene.phase.keys() {
        all.extend(scene.equation_of_state(phase));
        all.extend(scene.rheology(phase));
    }
    all.extend(scene.body.keys().filter_map(|body| scene.initial(body)));
    all.extend(scene.reference.keys().filter_map(|r| scene.solution(r)));
    all.extend(scene.probes().into_iter().map(|(_, probe)| probe));
    all
}
