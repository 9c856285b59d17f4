//! Builds plugins by their names, and collects what is wrong with all of them before giving up.

use serde_json::{Value as Json, json};
use sph_contribution::{Contribution, open_kinds};
use sph_core::{Makes, PluginInfo, Registry, SceneProblem};
use sph_scene::{PluginChoice, Scene};

use crate::defaults;
use crate::setup::in_force::PluginInForce;

/// A contribution with the kind of plugin that it comes from.
pub type Part<const D: usize> = (&'static str, Box<dyn Contribution<D>>);

/// Builds what a scene names.
pub struct Builder<'a> {
    /// The scene.
    pub scene: &'a Scene,
    /// What is wrong so far.
    pub problems: Vec<SceneProblem>,
    /// What is built so far.
    pub in_force: Vec<PluginInForce>,
}

impl<'a> Builder<'a> {
    /// A builder that has built nothing yet.
    pub fn new(scene: &'a Scene) -> Self {
        Builder {
            scene,
            problems: Vec::new(),
            in_force: Vec::new(),
        }
    }

    /// The plugin of a choice.
    fn build<const D: usize, E: Makes<D>>(
        &mut self,
        choice: &PluginChoice,
    ) -> Option<Box<E::Made>> {
        let built = Registry::<E>::discovered()
            .and_then(|registry| registry.find(&choice.name))
            .and_then(|entry| entry.make(&choice.table).map(|made| (made, *entry.info())));
        match built {
            Ok((made, info)) => {
                self.in_force.push(in_force(choice, &info));
                Some(made)
            }
            Err(error) => {
                self.problems.extend(choice.blame(&error));
                None
            }
        }
    }

    /// The one plugin of a kind that the scene names, or the default.
    pub fn one<const D: usize, E: Makes<D>>(&mut self) -> Option<Box<E::Made>> {
        let kind = E::KIND;
        let default = || defaults::of(kind).map(|name| PluginChoice::default_of(kind, name));
        let choice = self.scene.choice(kind).or_else(default)?;
        self.build::<D, E>(&choice)
    }

    /// The same if it is `needed`; if not, a scene that names one is told why it is `idle`.
    pub fn where_needed<const D: usize, E: Makes<D>>(
        &mut self,
        needed: bool,
        idle: &str,
    ) -> Option<Box<E::Made>> {
        if needed {
            return self.one::<D, E>();
        }
        // What is wrong with a law may be why nothing needs it.
        if let (Some(named), true) = (self.scene.choice(E::KIND), self.problems.is_empty()) {
            self.problems.push(SceneProblem::new(named.path, idle));
        }
        None
    }

    /// All of several choices.
    pub fn each<const D: usize, E: Makes<D>>(
        &mut self,
        choices: Vec<PluginChoice>,
    ) -> Vec<Box<E::Made>> {
        let each = choices.iter();
        each.filter_map(|choice| self.build::<D, E>(choice))
            .collect()
    }

    /// All of several choices, with their names.
    pub fn named<const D: usize, E: Makes<D>>(
        &mut self,
        choices: impl IntoIterator<Item = (String, PluginChoice)>,
    ) -> Vec<(String, Box<E::Made>)> {
        let mut all = Vec::new();
        for (name, choice) in choices {
            all.extend(self.build::<D, E>(&choice).map(|made| (name, made)));
        }
        all
    }

    /// All plugins of open kinds.
    pub fn contributions<const D: usize>(&mut self) -> Vec<Part<D>> {
        let mut all = Vec::new();
        for kind in open_kinds() {
            for choice in self.scene.choices(kind.kind) {
                match kind.build::<D>(&choice.name, &choice.table) {
                    Ok((built, info)) => {
                        self.in_force.push(in_force(&choice, &info));
                        all.push((kind.kind, built));
                    }
                    Err(error) => self.problems.extend(choice.blame(&error)),
                }
            }
        }
        all
    }
}

fn in_force(choice: &PluginChoice, info: &PluginInfo) -> PluginInForce {
    let mut parameters = serde_json::Map::new();
    for (name, value) in sph_core::defaults(&(info.schema)()) {
        parameters.insert(name, value);
    }
    let given = serde_json::to_value(&choice.table).unwrap_or(json!({}));
    if let Json::Object(given) = given {
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
