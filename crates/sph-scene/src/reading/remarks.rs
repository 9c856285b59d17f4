//! Remarks on the parameters of plugins: numbers that nature does not have.

use sph_core::{SceneProblem, conform, contracts, kinds};
use toml::Value;

use crate::Scene;
use crate::reading::plugins::PluginChoice;

/// What is to be said of the parameters of every plugin that is known by its name; those that are wrong are left
/// to whoever builds it.
pub(crate) fn of_plugins(scene: &Scene) -> Vec<SceneProblem> {
    choices(scene).iter().flat_map(of).collect()
}

fn of(choice: &PluginChoice) -> Vec<SceneProblem> {
    let kind = contracts().into_iter().find(|c| c.kind == choice.kind);
    let plugins = kind.map_or(Vec::new(), |c| (c.plugins)());
    let Some(plugin) = plugins.iter().find(|p| p.name == choice.name) else {
        return Vec::new();
    };
    let mut table = Value::Table(choice.table.clone());
    let remarks = conform(&mut table, &(plugin.schema)()).unwrap_or_default();
    let inside = |r: &SceneProblem| SceneProblem::new(choice.inside(&r.path), r.message.clone());
    remarks.iter().map(inside).collect()
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
