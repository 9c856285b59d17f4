//! The plugins of a scene, built by their names.

use std::cell::RefCell;

use serde::Serialize;
use serde_json::{Map, Value as Json};
use sph_core::{Contract, Makes, PluginChoice, PluginInfo, Registry, SceneProblem};

/// A plugin in force, with all its parameters.
#[derive(Clone, Debug, Serialize, serde::Deserialize)]
pub struct PluginInForce {
    /// Kind of plugin.
    pub kind: String,
    /// Its name.
    pub name: String,
    /// Path of its table in the scene.
    pub path: String,
    /// Crate and version that registered it.
    pub provider: String,
    /// Parameters as given, and the defaults of the others.
    pub parameters: Json,
}

/// The plugins that a scene names, and the defaults of kinds of which it names none.
///
/// Every call builds a plugin anew. Faults of names and parameters are collected.
pub struct Plugins {
    choices: Vec<PluginChoice>,
    phases: Vec<Vec<PluginChoice>>,
    /// Names of the columns that outputs show and probes measure.
    pub shown: Vec<String>,
    found: RefCell<PluginReport>,
}

#[derive(Default)]
struct PluginReport {
    problems: Vec<SceneProblem>,
    in_force: Vec<PluginInForce>,
}

impl Plugins {
    /// The plugins of the scene's own tables, `[KIND.PLUGIN]`, and those of every phase, in the order of the phases.
    pub fn new(choices: Vec<PluginChoice>, phases: Vec<Vec<PluginChoice>>) -> Self {
        Plugins {
            choices,
            phases,
            shown: Vec::new(),
            found: RefCell::default(),
        }
    }

    /// True if the scene names a plugin of a kind.
    pub fn names(&self, kind: &str) -> bool {
        self.choices.iter().any(|choice| choice.kind == kind)
    }

    /// The one plugin of a kind that the scene names, or the default.
    pub fn one<const D: usize, E: Makes<D>>(&self) -> Option<Box<E::Made>> {
        self.build_one::<D, E>(&self.choices)
    }

    fn build_one<const D: usize, E: Makes<D>>(
        &self,
        choices: &[PluginChoice],
    ) -> Option<Box<E::Made>> {
        let named = choices.iter().find(|c| c.kind == E::KIND.name);
        self.build::<D, E>(&named.cloned().or_else(default::<E>)?)
    }

    /// All plugins of a kind that the scene names.
    pub fn all<const D: usize, E: Makes<D>>(&self) -> Vec<Box<E::Made>> {
        let own = self.choices.iter().filter(|c| c.kind == E::KIND.name);
        own.filter_map(|choice| self.build::<D, E>(choice))
            .collect()
    }

    /// The plugins of a kind of all phases, or the default of those that name none, in the order of the phases.
    pub fn of_phases<const D: usize, E: Makes<D>>(&self) -> Vec<Box<E::Made>> {
        let phases = self.phases.iter();
        phases.filter_map(|c| self.build_one::<D, E>(c)).collect()
    }

    /// Plugins of choices with names.
    pub fn named<const D: usize, E: Makes<D>>(
        &self,
        choices: impl IntoIterator<Item = (String, PluginChoice)>,
    ) -> Vec<(String, Box<E::Made>)> {
        let one = |(name, choice)| Some((name, self.build::<D, E>(&choice)?));
        choices.into_iter().filter_map(one).collect()
    }

    fn build<const D: usize, E: Makes<D>>(&self, choice: &PluginChoice) -> Option<Box<E::Made>> {
        let built = Registry::<E>::discovered()
            .and_then(|registry| registry.find(&choice.name))
            .and_then(|entry| entry.make(&choice.table).map(|made| (made, *entry.info())));
        let mut found = self.found.borrow_mut();
        match built {
            Ok((made, info)) => {
                if found.in_force.iter().all(|p| p.path != choice.path) {
                    found.in_force.push(in_force(choice, &info));
                }
                Some(made)
            }
            Err(error) => {
                let new = choice.scene_problems(&error).into_iter();
                let new: Vec<_> = new.filter(|p| !found.problems.contains(p)).collect();
                found.problems.extend(new);
                None
            }
        }
    }

    /// All plugins that were built, by their kinds; call it after all plugins were.
    ///
    /// # Errors
    /// Everything that was wrong with names and parameters; if nothing was, tables of plugins that the scene has no use
    /// for.
    pub fn in_force(self) -> Result<Vec<PluginInForce>, Vec<SceneProblem>> {
        let PluginReport {
            mut problems,
            mut in_force,
        } = self.found.into_inner();
        if problems.is_empty() {
            let idle = self.choices.into_iter().filter_map(|choice| {
                let message = sph_core::kind_of(choice.kind)?.idle?;
                let used = in_force.iter().any(|p| p.path == choice.path);
                (!used).then(|| SceneProblem::new(choice.path, message))
            });
            problems.extend(idle);
        }
        in_force.sort_by(|a, b| a.kind.cmp(&b.kind));
        match problems.is_empty() {
            true => Ok(in_force),
            false => Err(problems),
        }
    }
}

fn default<E: Contract>() -> Option<PluginChoice> {
    let kind = E::KIND;
    Some(PluginChoice::default_of(kind.name, kind.default?))
}

fn in_force(choice: &PluginChoice, info: &PluginInfo) -> PluginInForce {
    let mut parameters: Map<String, Json> =
        sph_core::defaults(&(info.schema)()).into_iter().collect();
    if let Ok(Json::Object(given)) = serde_json::to_value(&choice.table) {
        parameters.extend(given);
    }
    PluginInForce {
        kind: choice.kind.to_string(),
        name: choice.name.clone(),
        path: choice.path.clone(),
        provider: info.provider.to_string(),
        parameters: Json::Object(parameters),
    }
}
